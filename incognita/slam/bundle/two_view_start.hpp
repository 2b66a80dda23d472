// Another start of bundle adjustment. A filter that begins without depths can converge to wrong ones: a motion forward and a
// rotation then explain each other. The relative pose of two views needs no depths.
#pragma once

#include "incognita/slam/bundle/adjust_bundle.hpp"

namespace incognita {

/// The bundle, with its last view at the pose that its matches with the first view determine, points of both views where their rays
/// intersect, and the views between where these points are seen from. Other points get the median depth. The scale makes the
/// median inverse depth that of the priors. Nothing if the matches do not determine the pose, or points are known. Only points
/// whose host is the first view determine it.
std::optional<Bundle> two_view_start(Bundle bundle, const Camera& camera,
                                     const AdjustmentSettings& settings = {});

}  // namespace incognita
