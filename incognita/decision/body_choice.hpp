// Interface of the choice of one body's next action.
#pragma once

#include <string>
#include <vector>

#include "incognita/decision/action_rule.hpp"
#include "incognita/decision/expectation.hpp"
#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class BodyChoice : public SavedPart {
 public:
  /// Updates the goal: scores the actions and, once per period, chooses the next one. `body`: with its block in
  /// `belief`.
  virtual void choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                      const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) = 0;
  /// To be called when tracking is lost: the next tick compares all actions again.
  virtual void forget() = 0;
  /// Names of the actions, constant over a run.
  virtual const std::vector<std::string>& names() const = 0;
};

}  // namespace incognita
