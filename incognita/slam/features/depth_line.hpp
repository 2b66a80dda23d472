// Depth estimation by hypotheses along a line: thesis C.3.
//
// A line is an inverse-depth landmark without its depth (5 errors in the belief). Its depth is a set of
// weighted hypotheses. Each projects into the image with its own ellipse, one correlation sheet serves all of
// them, and the match re-weights them. When sigma/depth is small the line is converted to a point with the
// Gaussian of its hypotheses.
#pragma once

#include "incognita/slam/features/feature.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

/// Searches for every line of the camera once and re-weights its hypotheses. Lines of converged depth become points;
/// lines with too many failed searches in a row, or without a consistent hypothesis, are dropped.
void update_depth_lines(const SummedImage& image, Estimate& estimate, TrackedCamera& camera);

/// Removes all lines of the camera, whose depths mean nothing when its pose is lost.
void drop_depth_lines(Estimate& estimate, TrackedCamera& camera);

}  // namespace incognita
