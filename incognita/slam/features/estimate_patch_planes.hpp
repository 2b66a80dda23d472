// Estimation of the patches' planes from the matches of a frame.
#pragma once

#include "incognita/slam/features/feature.hpp"

namespace incognita {

/// For every match on a patch of unknown plane: the position uncertainty due to the plane (`plane_cov`, added
/// to the measurement noise), and the information of the match about the plane.
void add_plane_uncertainty(const Image& image, TrackedCamera& camera);

/// To be called after the update, with the updated viewpoint: estimates the planes from the inliers, at most once per
/// new view, since the noise of the stored patch is common to all views.
void estimate_patch_planes(const Estimate& estimate, TrackedCamera& camera);

}  // namespace incognita
