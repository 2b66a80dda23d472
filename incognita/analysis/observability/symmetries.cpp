#include "incognita/analysis/observability/symmetries.hpp"

#include <Eigen/SVD>
#include <utility>

#include "incognita/math/median.hpp"

namespace incognita {
namespace {

using Form = SpatialScene::Landmark::Form;

/// Symmetries of an inverse-depth landmark. Its anchor position moves as any point. Its direction r = (m, 1),
/// in fixed axes, rotates by e x r and is renormalized to z = 1, which also changes the inverse depth. A
/// change of scale leaves the direction.
void put_inverse_depth(const SpatialScene::Landmark& landmark, const Eigen::Vector3d& c,
                       Eigen::Ref<Eigen::MatrixXd> N) {
  const InverseDepthLandmark::State& y = landmark.mean;
  N.topRows<3>() = displacement(y.head<3>(), c);
  const Eigen::Vector3d ray(y[3], y[4], 1);
  const Eigen::Matrix3d initial_camera_from_world =
      rotation_matrix<double>(landmark.initial_axes.world_from_initial_camera).transpose();
  const Eigen::Matrix3d turned =
      -skew<double>(ray) * initial_camera_from_world;  // d(e x r) / d(rotation in the world)
  N.block<2, 3>(3, 3) = turned.topRows<2>() - ray.head<2>() * turned.row(2);
  if (landmark.form == Form::ray) return;
  N.block<1, 3>(5, 3) = -y[5] * turned.row(2);
  N(5, 6) = -y[5];
}

/// The median; 1 m without any, and if it is 0.
double typical(std::vector<double> distances_m) {
  const double middle = distances_m.empty() ? 0 : median(distances_m);
  return middle > 0 ? middle : 1;
}

}  // namespace

std::optional<LandmarkPoint> landmark_point(const SpatialScene::Landmark& landmark) {
  switch (landmark.form) {
    case Form::point:
      return LandmarkPoint{landmark.mean.head<3>(), Eigen::Matrix3d::Identity()};
    case Form::ray:
      return std::nullopt;
    case Form::inverse_depth:
      break;
  }
  if (!(landmark.mean[5] > 1e-6)) return std::nullopt;
  const auto point = landmark.initial_axes.point(landmark.mean);
  return LandmarkPoint{point.position, point.J};
}

Eigen::MatrixXd displacement(const Eigen::VectorXd& point, const Eigen::VectorXd& c) {
  const Eigen::VectorXd from = point - c;
  if (from.size() == 2) {
    Eigen::Matrix<double, 2, 3> D;
    D << Eigen::Matrix2d::Identity(), Eigen::Vector2d(-from.y(), from.x());
    return D;
  }
  Eigen::Matrix<double, 3, 7> D;
  D << Eigen::Matrix3d::Identity(), -skew<double>(from), from;
  return D;
}

Eigen::MatrixXd symmetry_directions(const PlanarScene& scene, const Eigen::Vector2d& c) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(scene.errors, PlanarScene::generators);
  for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(3 * i);
    N.middleRows<2>(first) = displacement(scene.vehicles[i].head<2>(), c);
    N(first + 2, 2) = 1;
  }
  for (const auto& landmark : scene.landmarks)
    N.middleRows<2>(landmark.first) = displacement(landmark.position, c);
  return N;
}

Eigen::MatrixXd symmetry_directions(const SpatialScene& scene, const Eigen::Vector3d& c) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(scene.errors, SpatialScene::generators);
  const Eigen::Vector3d v = free_camera::velocity(scene.camera);
  N.topRows<3>() = displacement(scene.position(), c);
  N.block<3, 3>(3, 3) = rotation_matrix<double>(free_camera::orientation(scene.camera)).transpose();
  N.block<3, 3>(6, 3) = -skew<double>(v);
  N.block<3, 1>(6, 6) = v;
  for (const auto& landmark : scene.landmarks) {
    if (landmark.form == Form::point)
      N.middleRows<3>(landmark.first) = displacement(landmark.mean.head<3>(), c);
    else
      put_inverse_depth(landmark, c, N.middleRows(landmark.first, landmark.form == Form::ray ? 5 : 6));
  }
  return N;
}

RemainingSymmetries remaining_symmetries(const Eigen::MatrixXd& points) {
  constexpr double least = 1e-3;  // relative to the spread
  const Eigen::Index dimension = points.rows(), generators = dimension == 2 ? 3 : 7;
  if (points.cols() == 0)
    return {Eigen::VectorXd::Zero(dimension), Eigen::MatrixXd::Identity(generators, generators)};
  const Eigen::VectorXd middle = points.rowwise().mean();
  const double spread = (points.colwise() - middle).colwise().norm().maxCoeff();
  const bool one_place = !(spread > 1e-9 * (1 + middle.norm()));
  // Rotations and scale in terms of displacements at the outermost point
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(generators);
  if (!one_place) scale.tail(generators - dimension).setConstant(1 / spread);
  Eigen::MatrixXd moved(dimension * points.cols(), generators);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    moved.middleRows(dimension * i, dimension) =
        displacement(one_place ? middle : Eigen::VectorXd(points.col(i)), middle) * scale.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(moved, Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  const Eigen::Index rank = (values.array() > least * values[0]).count();
  Eigen::MatrixXd basis = scale.asDiagonal() * svd.matrixV().rightCols(generators - rank);
  for (Eigen::Index i = 0; i < basis.cols(); ++i) basis.col(i).normalize();
  return {middle, basis};
}

double typical_distance(const PlanarScene& scene) {
  std::vector<double> distances;
  for (const auto& landmark : scene.landmarks)
    distances.push_back((landmark.position - scene.position()).norm());
  return typical(std::move(distances));
}

double typical_distance(const SpatialScene& scene) {
  std::vector<double> distances;
  for (const auto& landmark : scene.landmarks)
    if (const auto at = landmark_point(landmark))
      distances.push_back((at->position - scene.position()).norm());
  return typical(std::move(distances));
}

Eigen::VectorXd units_of(const PlanarScene& scene) {
  const double length = typical_distance(scene);
  Eigen::VectorXd units = Eigen::VectorXd::Constant(scene.errors, length);
  for (std::size_t i = 0; i < scene.vehicles.size(); ++i) units[static_cast<Eigen::Index>(3 * i + 2)] = 1;
  return units;
}

Eigen::VectorXd units_of(const SpatialScene& scene) {
  const double length = typical_distance(scene);
  Eigen::VectorXd units = Eigen::VectorXd::Constant(scene.errors, length);
  units.segment<3>(3).setOnes();  // rad
  units.segment<3>(9).setOnes();  // rad/s; velocities: the typical distance per second
  for (const auto& landmark : scene.landmarks) {
    if (landmark.form == Form::point) continue;
    units.segment<2>(landmark.first + 3).setOnes();
    if (landmark.form == Form::inverse_depth) units[landmark.first + 5] = 1 / length;
  }
  return units;
}

}  // namespace incognita
