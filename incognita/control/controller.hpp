// The interface of the controller in the loop: from the goal to the next command.
#pragma once

#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class Controller : public SavedPart {
 public:
  /// The command until the next tick.
  virtual Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
                      const Tick& tick) = 0;
};

}  // namespace incognita
