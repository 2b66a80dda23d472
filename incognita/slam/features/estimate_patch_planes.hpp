// Estimation of the patches' planes from the matches of a frame.
#pragma once

#include <vector>

#include "incognita/slam/features/estimate.hpp"

namespace incognita {

/// For every match on a patch of unknown plane: the position uncertainty due to the plane (`plane_cov`, added
/// to the measurement noise), and the information of the match about the plane.
void add_plane_uncertainty(const Estimate& estimate, const Camera& camera, const Image& image,
                           int patch_size_px, std::vector<FeatureMatch>& matches);

/// To be called after the update: estimates the planes from the inliers, at most once per new view, since the
/// noise of the stored patch is common to all views.
void estimate_patch_planes(Estimate& estimate, const std::vector<FeatureMatch>& matches);

}  // namespace incognita
