// Which landmarks should be seen from here, where, how surely, and what they should look like.
#pragma once

#include <vector>

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// About where a landmark is; never a line. An inverse depth near zero is taken as 100 m away.
Eigen::Vector3d nominal_position(const Landmark& landmark, const Belief& belief);

/// As predict_match(), but not how the patch would look: what an imagined look needs.
std::optional<FeatureMatch> predict_pixel(const Landmark& landmark, const Belief& belief,
                                          const Camera& camera, const CameraState& from,
                                          const CameraSlamSettings& settings);

/// The look of one landmark from a camera state, or nothing when it should not be seen: behind the camera,
/// outside the image, or seen too differently from its birth view for its patch to match (thesis C.4). The
/// innovation covariance is left for fill_innovation().
std::optional<FeatureMatch> predict_match(const Landmark& landmark, const Belief& belief,
                                          const Camera& camera, const CameraState& from,
                                          const CameraSlamSettings& settings);

/// The look as the belief understands it, with a zero residual: two rows, camera and landmark blocks.
LinearizedMeasurement linearized_measurement(const FeatureMatch& match, const Landmark& landmark,
                                             BlockId camera, double sigma_pixel_px);

/// Looks of all anchors and mapped landmarks that should be seen now, innovation covariances included.
void predict_matches(const Estimate& estimate, const Camera& camera, const CameraSlamSettings& settings,
                     std::vector<FeatureMatch>& matches);

/// How a small piece of the plane through `point` with this unit normal (both world) maps from pixels of a
/// view to pixels of the patch's own view, 2x2. Nothing when the plane is seen from behind or edge on.
std::optional<Eigen::Matrix2d> local_warp(const PatchView& view, const Eigen::Vector3d& normal,
                                          const Eigen::Vector3d& point, const Eigen::Vector2d& pixel,
                                          const Camera& camera, const CameraState& from);

}  // namespace incognita
