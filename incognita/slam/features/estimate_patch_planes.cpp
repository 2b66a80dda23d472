#include "incognita/slam/features/estimate_patch_planes.hpp"

#include <cmath>

#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {
namespace {

constexpr double slope_step = 0.1;
constexpr double new_view_rad = 0.03;    // change of viewing direction that makes a new view
constexpr double new_view_scale = 0.05;  // relative change of distance that makes a new view
constexpr double max_depth_ratio = 0.1;  // sigma/depth; above it the scale of the warp is too uncertain

std::optional<PatchTemplate> template_at(const PatchView& view, const Eigen::Vector2d& slope,
                                         const FeatureMatch& match, const Camera& camera,
                                         const CameraState& from, int patch_size_px) {
  const auto texture_from_view =
      local_warp(view, view.plane.normal(slope), match.point, match.predicted, camera, from);
  if (!texture_from_view) return std::nullopt;
  return warp(view.texture, *texture_from_view, patch_size_px);
}

std::optional<PlaneEvidence> evidence_of(const PatchView& view, const FeatureMatch& match,
                                         const Camera& camera, const CameraState& from, const Image& image,
                                         int patch_size_px) {
  const auto tried = [&](const Eigen::Vector2d& slope) {
    return template_at(view, slope, match, camera, from, patch_size_px);
  };
  const Eigen::Vector2d now = view.plane.slope;
  const auto expected = tried(now), first = tried(now + slope_step * Eigen::Vector2d::UnitX()),
             second = tried(now + slope_step * Eigen::Vector2d::UnitY());
  if (!expected || !first || !second) return std::nullopt;
  return plane_evidence(image, *match.measured, *expected, {*first, *second}, slope_step);
}

bool depth_is_known(const Landmark& landmark, const AnyBelief& belief) {
  if (landmark.form.kind == LandmarkParametrization::Kind::point) return true;
  const double inverse_depth = belief.mean(landmark.block)[5];
  const double var = belief.covariance(landmark.block)(5, 5);
  return var < std::pow(max_depth_ratio * inverse_depth, 2);
}

bool is_new_view(const PatchView& view, const Eigen::Vector3d& point, const Eigen::Vector3d& from) {
  const Eigen::Vector3d now = point - from, then = point - view.plane.estimated_from;
  const double ratio = now.norm() / then.norm();
  return now.dot(then) < std::cos(new_view_rad) * now.norm() * then.norm() || ratio > 1 + new_view_scale ||
         ratio < 1 - new_view_scale;
}

}  // namespace

void add_plane_uncertainty(const Image& image, TrackedCamera& camera) {
  for (FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched || match.level > 0) continue;
    const PatchView& view = camera.features.at(match.id).view;
    if (view.plane.known()) continue;
    match.plane = evidence_of(view, match, camera.camera, camera.view.camera, image,
                              camera.settings.search.patch_size_px);
    if (!match.plane) continue;
    const Eigen::Matrix2d& shift = match.plane->shift_per_slope;
    match.plane_cov = shift * view.plane.slope_cov * shift.transpose();
  }
}

void estimate_patch_planes(const Estimate& estimate, TrackedCamera& camera) {
  const Eigen::Vector3d from = free_camera::position(camera.view.camera);
  for (const FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched || !match.plane) continue;
    PatchView& view = camera.features.at(match.id).view;
    if (!is_new_view(view, match.point, from) ||
        !depth_is_known(estimate.landmarks.at(match.id), estimate.belief))
      continue;
    update_patch_plane(view.plane, *match.plane);
    view.plane.estimated_from = from;
  }
}

}  // namespace incognita
