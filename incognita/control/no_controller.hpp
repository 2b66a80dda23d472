// Where there is nothing to steer, as in a recorded drive.
#pragma once

#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

struct NoController {
  template <class Estimate>
  Command act(const Estimate&, const Goal&, const Observation&, const Tick&) const {
    return {};
  }
};

}  // namespace incognita
