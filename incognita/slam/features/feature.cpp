#include "incognita/slam/features/feature.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "incognita/math/median.hpp"

namespace incognita {

Viewpoint viewpoint(const Estimate& e, const TrackedCamera& c) {
  const BlockId block = e.bodies[c.body].block;
  return {block, e.belief.mean(block), {}};
}

MeasurementJacobian Viewpoint::jacobian(const CameraJacobian& by_camera) const {
  if (by_body.size() == 0) return by_camera;
  return by_camera.leftCols<6>() * by_body;
}

Viewpoint viewpoint_of(const SmallVector& state, const AnyMotion& motion, const std::optional<Mount>& mount,
                       BlockId body) {
  if (!mount) return {body, state, {}};
  const MountedCamera<6> mounted =
      mount->on(PoseOf<6>{pose_of(motion, state), Eigen::Matrix<double, 6, 6>::Identity()});
  return {body, mounted.camera, mounted.J * pose_jacobian(motion, state)};
}

Viewpoint viewpoint(const Estimate& e, const TrackedCamera& c, const AnyMotion& motion) {
  const BlockId block = e.bodies[c.body].block;
  return viewpoint_of(e.belief.mean(block), motion, c.mount, block);
}

DepthPrior TrackedCamera::depth_prior() const {
  const InitializationSettings& s = settings.initialization;
  using Scale = InitializationSettings::ScalePrior;
  if (s.scale_prior_to_view == Scale::never) return {s.inverse_depth_per_m, s.sigma_inverse_depth_per_m};
  // Where all that is matched is far, something nearer may still come into view
  const double least = s.scale_prior_to_view == Scale::always ? 0.3 : 1;
  const double scale = std::max(least, 1 / (median_depth_m * s.inverse_depth_per_m));
  return {scale * s.inverse_depth_per_m, scale * s.sigma_inverse_depth_per_m};
}

std::optional<Eigen::Vector3d> current_position(const Estimate& e, const Landmark& landmark,
                                                const Feature& feature) {
  if (landmark.fixed) return Eigen::Vector3d(landmark.position);
  if (landmark.form.kind == LandmarkParametrization::Kind::ray) {
    const auto y = ray_at(landmark, e.belief, 1 / depth_of(feature.depths).mean);
    return InverseDepthLandmark{landmark.form.initial_axes}.point(y).position;
  }
  const auto at = position_of(landmark.form, SmallVector(e.belief.mean(landmark.block)));
  return at ? std::optional<Eigen::Vector3d>(at->position) : std::nullopt;
}

std::optional<double> depth_of_view(const Estimate& estimate, const TrackedCamera& camera) {
  const bool only_known =
      camera.settings.initialization.scale_prior_to_view == InitializationSettings::ScalePrior::always;
  const Eigen::Vector3d from = free_camera::position(camera.view.camera);
  thread_local std::vector<double> distances;
  distances.clear();
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched) continue;
    if (only_known && estimate.landmarks.at(match.id).form.kind != LandmarkParametrization::Kind::point)
      continue;
    distances.push_back((match.point - from).norm());
  }
  if (distances.empty()) return std::nullopt;
  return median(distances);
}

}  // namespace incognita
