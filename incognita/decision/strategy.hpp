// The interface of the decision in the loop: which action comes next.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class Strategy : public SavedPart {
 public:
  /// The goal of every body, with the scores of all candidate actions. No action is chosen without a pose (not started,
  /// lost).
  virtual Goal choose(const Estimate& estimate, const Observation& observation, const Tick& tick) = 0;
  /// A person has driven the body: what was chosen for it before no longer counts.
  virtual void restart(std::size_t) {}
  /// Names of the candidate actions of a body, constant over a run.
  virtual const std::vector<std::string>& actions(std::size_t body) const = 0;
};

}  // namespace incognita
