// Steers each vehicle of a team along a path of its own, or to the goals that a decision sets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "incognita/control/person.hpp"
#include "incognita/control/steering.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/team_estimate.hpp"

namespace incognita {

struct VehicleSteering {
  AnyMotion motion;
  SteeringSettings settings;
};

class TeamController {
 public:
  /// `period_s`: how long a command is held. `person`: one for each body in space, who may move it by hand.
  /// Throws std::invalid_argument as make_steering and Person do.
  TeamController(std::vector<VehicleSteering> vehicles, double period_s, const PersonSettings& person = {},
                 std::uint64_t seed = 1);

  /// Nothing before the start; once lost, bodies in space brake from their last known motion. Goals for the
  /// team, newly decided, take the place of the paths.
  /// Persons go by what their hands feel, seen.felt, and not by the estimate.
  Command act(const TeamEstimate& estimate, const Goal& goal, const Observation& seen, const Tick& tick);

 private:
  void turn_to(const Goal& goal);
  Command brake(const Tick& tick);
  void take_states(const TeamEstimate& estimate, const Observation& seen);
  SmallVector fly(const Goal& goal, std::size_t vehicle, const Tick& tick);

  std::vector<VehicleSteering> vehicles_;
  double period_s_;
  std::vector<std::unique_ptr<Steering>> laws_;
  std::vector<Person> persons_;  ///< one for each vehicle, or none
  std::optional<double> first_t_, lost_t_;
  std::vector<SmallVector> last_known_;
};

}  // namespace incognita
