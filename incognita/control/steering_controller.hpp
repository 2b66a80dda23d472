// The controller of all bodies: each along its own path or to the goals of a decision.
#pragma once

#include <optional>
#include <vector>

#include "incognita/control/body_controller.hpp"
#include "incognita/control/controller.hpp"

namespace incognita {

class SteeringController final : public Controller {
 public:
  /// One per body; none where nothing is controlled, as in a recording. `period_s`: duration of one command. Throws
  /// std::invalid_argument as BodyController does.
  explicit SteeringController(std::vector<BodyControl> bodies = {}, double period_s = 1);

  /// Empty before the start.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
              const Tick& tick) override;

  void state(StateArchive& archive) override;

 private:
  std::vector<BodyController> bodies_;
  std::optional<double> first_t_;
};

}  // namespace incognita
