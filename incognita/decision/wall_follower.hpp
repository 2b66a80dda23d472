// Goes around along the sides of the allowed box, at a stated distance from them.
#pragma once

#include <memory>

#include "incognita/decision/action_rule.hpp"

namespace incognita {

/// It goes counterclockwise as seen from above, the sides on its right, at the height of the start, from the nearest side on.
/// Throws std::invalid_argument if the bounds leave no way around.
std::unique_ptr<ActionRule> wall_follower(const DecisionSettings& settings, const Mobility& mobility);

}  // namespace incognita
