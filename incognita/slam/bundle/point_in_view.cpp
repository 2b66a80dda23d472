#include "incognita/slam/bundle/point_in_view.hpp"

#include <cmath>

namespace incognita {
namespace {

/// The vector from the view to the landmark times `scale`, the inverse depth or 1 for a point: finite at infinity.
struct ScaledVector {
  Eigen::Vector3d in_world;
  double scale = 1;
};

ScaledVector scaled_vector(const Landmark& landmark, const AnyBelief& belief, const BundleView& view) {
  const auto y = belief.mean(landmark.block);
  if (landmark.form.kind == LandmarkParametrization::Kind::point) return {Eigen::Vector3d(y) - view.position};
  return {y[5] * (Eigen::Vector3d(y.head<3>()) - view.position) +
              rotation_matrix<double>(landmark.form.initial_axes) * Eigen::Vector3d(y[3], y[4], 1),
          y[5]};
}

}  // namespace

std::optional<Eigen::Vector3d> point_in_view(const Landmark& landmark, const AnyBelief& belief,
                                             const BundleView& view) {
  if (landmark.form.kind == LandmarkParametrization::Kind::ray) return std::nullopt;
  const ScaledVector to = scaled_vector(landmark, belief, view);
  const Eigen::Vector3d along = rotation_matrix<double>(view.world_from_camera).transpose() * to.in_world;
  if (!(along.z() > 0.1 * along.norm())) return std::nullopt;
  return Eigen::Vector3d(along.x(), along.y(), to.scale) / along.z();
}

double sigma_inverse_depth_in_view(const Landmark& landmark, const AnyBelief& belief, BlockId body) {
  const BundleView view = view_of(belief.mean(body));
  const ScaledVector to = scaled_vector(landmark, belief, view);
  const Eigen::Matrix3d R = rotation_matrix<double>(view.world_from_camera);
  const Eigen::Vector3d axis = R.col(2), along = R.transpose() * to.in_world;
  const double z = along.z(), by_z = -to.scale / (z * z);
  const bool is_point = landmark.form.kind == LandmarkParametrization::Kind::point;
  Eigen::RowVectorXd by_body = Eigen::RowVectorXd::Zero(belief.chart(body).tangent());
  Eigen::RowVectorXd by_landmark = Eigen::RowVectorXd::Zero(is_point ? 3 : 6);
  by_body.head<3>() = -by_z * to.scale * axis.transpose();
  by_body.segment<3>(3) << -by_z * along.y(), by_z * along.x(), 0;  // the right rotation error turns `along`
  by_landmark.head<3>() = by_z * to.scale * axis.transpose();
  if (!is_point) {
    const Eigen::Vector3d from = belief.mean(landmark.block).head<3>();
    const Eigen::Vector3d by_direction =
        rotation_matrix<double>(landmark.form.initial_axes).transpose() * axis;
    by_landmark.segment<2>(3) = by_z * by_direction.head<2>().transpose();
    by_landmark[5] = 1 / z + by_z * axis.dot(from - view.position);
  }
  const double var = (by_body * belief.covariance(body) * by_body.transpose() +
                      by_landmark * belief.covariance(landmark.block) * by_landmark.transpose() +
                      2 * by_body * belief.covariance(body, landmark.block) * by_landmark.transpose())
                         .value();
  return std::sqrt(std::max(var, 0.0));
}

}  // namespace incognita
