// The planes of the patches, from the matches of a frame.
#pragma once

#include <vector>

#include "incognita/slam/features/estimate.hpp"

namespace incognita {

/// For every match on a plane that is not known: how much that may have shifted it (`plane_cov`, part of what
/// the measurement is taken to be worth), and what it says of the plane.
void add_plane_uncertainty(const Estimate& estimate, const Camera& camera, const Image& image,
                           int patch_size_px, std::vector<FeatureMatch>& matches);

/// After the update: lets the matches that stood teach their planes, each once per new view, as the noise of
/// the stored patch is the same in all of them.
void estimate_patch_planes(Estimate& estimate, const std::vector<FeatureMatch>& matches);

}  // namespace incognita
