#include "incognita/models/sensors/camera_measurement.hpp"

#include <Eigen/LU>
#include <cmath>

namespace incognita {
namespace {

/// d(pixel)/d(camera error) for a vector c = C (s X - s p) in camera axes, d = d(pixel)/dc, C =
/// camera_from_world: the position changes c by -s C, the right rotation error by [c]x.
CameraJacobian camera_jacobian(const Eigen::Matrix<double, 2, 3>& d, const Eigen::Matrix3d& camera_from_world,
                               const Eigen::Vector3d& c, double s) {
  CameraJacobian H = CameraJacobian::Zero();
  H.leftCols<3>() = -s * d * camera_from_world;
  H.middleCols<3>(3) = d * skew(c);
  return H;
}

}  // namespace

std::optional<PointLandmark::Prediction> PointLandmark::predict_measurement(const Camera& camera,
                                                                            const CameraState& x,
                                                                            const State& point) {
  const Eigen::Matrix3d camera_from_world = rotation_matrix<double>(free_camera::orientation(x)).transpose();
  const Eigen::Vector3d c = camera_from_world * (point - free_camera::position(x));
  const auto projected = camera.project(c);
  if (!projected) return std::nullopt;
  return Prediction{projected->pixel, camera_jacobian(projected->J, camera_from_world, c, 1),
                    projected->J * camera_from_world};
}

Eigen::Matrix3d PointLandmark::by_world_turn(const State& point) { return -skew<double>(point); }

std::optional<InverseDepthLandmark::Prediction> InverseDepthLandmark::predict_measurement(
    const Camera& camera, const CameraState& x, const State& y) const {
  const Eigen::Matrix3d camera_from_world = rotation_matrix<double>(free_camera::orientation(x)).transpose();
  const Eigen::Vector3d c = in_camera<double>(x, y);
  const auto projected = camera.project(c);
  if (!projected) return std::nullopt;
  Prediction prediction{projected->pixel,
                        camera_jacobian(projected->J, camera_from_world, c, y[5]),
                        {},
                        projected->J * camera_from_world};
  const Eigen::Matrix<double, 2, 3>& d_world = prediction.by_parallax;
  prediction.Hl.leftCols<3>() = y[5] * d_world;
  prediction.Hl.middleCols<2>(3) = d_world * rotation_matrix<double>(world_from_initial_camera).leftCols<2>();
  prediction.Hl.col(5) = d_world * (y.head<3>() - free_camera::position(x));
  return prediction;
}

std::optional<InverseDepthLandmark::Initialization> InverseDepthLandmark::initialize(
    const Camera& camera, const CameraState& x, const Eigen::Vector2d& pixel, double inverse_depth) {
  const auto ray = camera.unproject(pixel);
  if (!ray) return std::nullopt;
  const auto projected = camera.project(*ray);
  if (!projected) return std::nullopt;
  Initialization initialization;
  initialization.world_from_initial_camera = free_camera::orientation(x);
  initialization.landmark << free_camera::position(x), ray->x(), ray->y(), inverse_depth;
  initialization.Jv.setZero();
  initialization.Jv.topLeftCorner<3, 3>().setIdentity();
  // The initial axes are constant while the camera rotates by its error e: the ray becomes r + e x r,
  // rescaled to z = 1
  const Eigen::Matrix3d turned = -skew<double>(*ray);
  initialization.Jv.block<2, 3>(3, 3) = turned.topRows<2>() - ray->head<2>() * turned.row(2);
  initialization.Jz.setZero();
  initialization.Jz.block<2, 2>(3, 0) = projected->J.leftCols<2>().inverse();
  return initialization;
}

Eigen::Matrix<double, 6, 3> InverseDepthLandmark::by_world_turn(const State& y) const {
  // The ray r of depth 1 becomes r + t x r in the initial axes; its depth along them, and with it that of the point, changes
  const Eigen::Vector3d ray(y[3], y[4], 1);
  const Eigen::Matrix3d turned =
      -skew<double>(ray) * rotation_matrix<double>(world_from_initial_camera).transpose();
  Eigen::Matrix<double, 6, 3> J;
  J.topRows<3>() = -skew<double>(y.head<3>());
  J.middleRows<2>(3) = turned.topRows<2>() - ray.head<2>() * turned.row(2);
  J.row(5) = -y[5] * turned.row(2);
  return J;
}

InverseDepthLandmark::Point InverseDepthLandmark::point(const State& y) const {
  const Eigen::Matrix3d axes = rotation_matrix<double>(world_from_initial_camera);
  const Eigen::Vector3d ray = axes * Eigen::Vector3d(y[3], y[4], 1);
  Point p{y.head<3>() + ray / y[5], {}};
  p.J.leftCols<3>().setIdentity();
  p.J.middleCols<2>(3) = axes.leftCols<2>() / y[5];
  p.J.col(5) = -ray / (y[5] * y[5]);
  return p;
}

double InverseDepthLandmark::linearity_index(const State& y, double inverse_depth_var,
                                             const Eigen::Vector3d& camera_position) const {
  if (!(y[5] > 0)) return 1e9;
  const Eigen::Vector3d at = point(y).position;
  const Eigen::Vector3d from_initial_camera = at - y.head<3>(), from_camera = at - camera_position;
  const double d0 = from_initial_camera.norm(), d1 = from_camera.norm();
  if (d0 < 1e-9 || d1 < 1e-9) return 1e9;
  // depth = |ray| / rho along the ray, so its sigma is |ray| sigma_rho / rho^2
  const double sigma_depth = d0 * std::sqrt(inverse_depth_var) / y[5];
  const double cos_parallax = from_initial_camera.dot(from_camera) / (d0 * d1);
  return 4 * sigma_depth / d1 * std::abs(cos_parallax);
}

}  // namespace incognita
