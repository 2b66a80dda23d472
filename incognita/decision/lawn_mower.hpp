// Sweeps the allowed box in parallel lanes, whatever is seen there.
#pragma once

#include <memory>
#include <vector>

#include "incognita/decision/action_rule.hpp"

namespace incognita {

/// The lanes follow the longer side of the bounds and are swept from the corner nearest to the start, layer by layer where the
/// actions change the height, and then back. Throws std::invalid_argument for bounds that hold no lane, or more than 10000.
std::unique_ptr<ActionRule> lawn_mower(const DecisionSettings& settings, const Mobility& mobility);

/// Both ends of all lanes, lane after lane, in the order of the sweep that starts nearest to `start`. Lanes lie in the middle of
/// strips that are at most `lane_m` wide and, with three axes, high.
std::vector<Eigen::Vector3d> lanes_of(const WorldBounds& bounds, double lane_m, int axes,
                                      const Eigen::Vector3d& start);

}  // namespace incognita
