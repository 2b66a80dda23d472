// A landmark of the belief as a point in inverse depth, seen from a view.
#pragma once

#include <optional>

#include "incognita/slam/bundle/bundle.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

/// Direction x, y in the axes of the view and inverse depth, 1/m; nothing for a ray, or behind the view.
std::optional<Eigen::Vector3d> point_in_view(const Landmark& landmark, const AnyBelief& belief,
                                             const BundleView& view);

/// Standard deviation of its inverse depth, 1/m, in the view of a free camera, the body, in the belief; of errors of both.
double sigma_inverse_depth_in_view(const Landmark& landmark, const AnyBelief& belief, BlockId body);

}  // namespace incognita
