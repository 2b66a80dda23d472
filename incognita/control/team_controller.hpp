// Steers each vehicle of a team along its own path, or to the goals of a decision.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "incognita/control/controller.hpp"
#include "incognita/control/steering.hpp"

namespace incognita {

struct VehicleSteering {
  AnyMotion motion;
  SteeringSettings settings;
};

class TeamController final : public Controller {
 public:
  /// `period_s`: duration of one command. `operator_controlled`: operators hold the vehicles, which must be
  /// free cameras, and are shown the goals. Throws std::invalid_argument as make_steering does.
  TeamController(std::vector<VehicleSteering> vehicles, double period_s, bool operator_controlled = false);

  /// Empty before the start; when lost, bodies in space brake from their last known motion. Newly decided
  /// team goals replace the paths.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
              const Tick& tick) override;

 private:
  void turn_to(const Goal& goal);
  Command brake(const Tick& tick);
  void take_states(const Estimate& estimate);
  SmallVector fly(const Goal& goal, std::size_t vehicle, const Tick& tick) const;
  Command shown(const Goal& goal, bool lost) const;

  std::vector<VehicleSteering> vehicles_;
  double period_s_;
  std::vector<std::unique_ptr<Steering>> laws_;
  bool operator_controlled_;
  std::optional<double> first_t_, lost_t_;
  std::vector<SmallVector> last_known_;
};

}  // namespace incognita
