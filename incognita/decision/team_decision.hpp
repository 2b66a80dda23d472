// The next move of each vehicle of a team: the one that teaches most (thesis 6.2), one vehicle after the
// other, each as if the others stood still. A camera that moves freely chooses translations and turns
// (6.3.1), one that is carried the changes of its carrier's speeds (6.4.2); vehicles on wheels and lines the
// translations that they can make.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/decision/team_expectation.hpp"
#include "incognita/decision/vehicle_choice.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

/// The gaze is held: CameraController alone swings it.
inline DecisionSettings with_held_gaze(DecisionSettings settings = {}) {
  settings.gaze = DecisionSettings::Gaze::hold;
  return settings;
}

struct TeamDecisionSettings {
  DecisionSettings decision = with_held_gaze();
  bool decides = true;          ///< false: there is nothing to decide
  double tick_s = 0.1;          ///< how long an input is held
  int max_measurements = 1000;  ///< of the map, in one set of imagined looks: the most uncertain
  ExplorationSettings exploration = {};
  std::optional<CarrierSettings> carrier = {};  ///< of cameras that do not fly but are carried
  std::uint64_t seed = 1;
};

class TeamDecision {
 public:
  /// Throws std::invalid_argument where the settings can not be.
  TeamDecision(TeamSettings team, const TeamDecisionSettings& settings);

  /// Compares all actions once per period and sets every vehicle's goal. Actions that would end outside the
  /// bounds are scored but not chosen. `scores` and `chosen` are the first vehicle's.
  Goal choose(const TeamEstimate& estimate, const Tick& tick);

  /// Names of the actions that the team's motion has: along a line, on the plane, in space.
  const std::vector<std::string>& actions() const { return names_; }

 private:
  void explore(const TeamEstimate& estimate, const Tick& tick);
  void choose_in_space(const TeamEstimate& estimate, const Tick& tick);
  void choose_for_carrier(const TeamEstimate& estimate, const Tick& tick);
  void share_goal(const Goal& first);
  void choose_on_ground(const TeamEstimate& estimate, const Tick& tick);

  TeamSettings team_;
  TeamDecisionSettings settings_;
  std::vector<std::string> names_;
  Exploration exploration_;
  TeamExpectation expectation_;
  std::vector<FreeCameraChoice> in_space_;              ///< one for each vehicle, of bodies in space
  std::vector<VehicleChoice> carried_;                  ///< or one for each carrier
  std::vector<std::unique_ptr<ActionSet>> action_set_;  ///< likewise, of all others
  std::vector<ActionChoice> on_ground_;
  Goal goal_;
  std::optional<double> entropy_due_t_;  ///< s, when the extended entropy is worked out again
};

}  // namespace incognita
