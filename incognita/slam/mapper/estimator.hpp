// The interface of the estimator in the loop.
#pragma once

#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class Estimator : public SavedPart {
 public:
  /// Advances the estimate from the previous tick to this one, in place. `observation` has one entry per body;
  /// `command` was executed since the previous tick.
  virtual void update(Estimate& estimate, const Command& command, const Observation& observation,
                      const Tick& tick) = 0;
};

}  // namespace incognita
