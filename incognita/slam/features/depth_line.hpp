// Finding a depth by hypotheses on a line: thesis C.3.
//
// A line is an inverse-depth landmark without its depth (5 errors in the belief). Its depth is a set of
// hypotheses; each projects into the image with its own ellipse, one correlation sheet serves them all, and
// what is found re-weights them. When sigma/depth is small the hypotheses become a Gaussian and the line a
// point of the map.
#pragma once

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

/// Searches for every line once and re-weights its hypotheses. Lines whose depth is known become points;
/// lines that were not found too often, or whose hypotheses all failed, are dropped.
void update_depth_lines(const SummedImage& image, Estimate& estimate, const Camera& camera,
                        const CameraSlamSettings& settings);

}  // namespace incognita
