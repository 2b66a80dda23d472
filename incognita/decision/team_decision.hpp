// Next action of each vehicle of a team: the most informative one (thesis 6.2), vehicle by vehicle, each as if the
// others stood still. A freely moving camera chooses translations and turns (6.3.1), a carried one its carrier's
// speed changes (6.4.2); vehicles on the ground or a line choose among the translations that they can execute.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/decision/strategy.hpp"
#include "incognita/decision/team_expectation.hpp"
#include "incognita/decision/vehicle_choice.hpp"

namespace incognita {

/// Holds the gaze: only CameraController swings it.
inline DecisionSettings with_held_gaze(DecisionSettings settings = {}) {
  settings.gaze = DecisionSettings::Gaze::hold;
  return settings;
}

struct TeamDecisionSettings {
  DecisionSettings decision = with_held_gaze();
  double tick_s = 0.1;          ///< duration of one input
  int max_measurements = 1000;  ///< predicted map measurements per set; the most uncertain are kept
  ExplorationSettings exploration = {};
  std::optional<CarrierSettings> carrier = {};  ///< vehicles that carry the cameras; empty for flying cameras
  std::uint64_t seed = 1;
};

class TeamDecision final : public Strategy {
 public:
  /// Throws std::invalid_argument for invalid settings.
  TeamDecision(EstimatorSettings team, const TeamDecisionSettings& settings);

  /// Compares all actions once per period and sets every vehicle's goal. Actions that would end outside the
  /// bounds are scored but not chosen. `scores` and `chosen` are those of the first vehicle.
  Goal choose(const Estimate& estimate, const Observation& observation, const Tick& tick) override;
  Goal choose(const Estimate& estimate, const Tick& tick) { return choose(estimate, {}, tick); }

  /// Names of the actions of the team's motion model: along a line, on the plane, or in space.
  const std::vector<std::string>& actions() const override { return names_; }

 private:
  void explore(const Estimate& estimate, const Tick& tick);
  void choose_in_space(const Estimate& estimate, const Tick& tick);
  void choose_for_carrier(const Estimate& estimate, const Tick& tick);
  void share_goal(const Goal& first);
  void choose_on_ground(const Estimate& estimate, const Tick& tick);

  EstimatorSettings team_;
  TeamDecisionSettings settings_;
  std::vector<std::string> names_;
  Exploration exploration_;
  TeamExpectation expectation_;
  std::vector<FreeCameraChoice> in_space_;              ///< one per vehicle, for bodies in space
  std::vector<VehicleChoice> carried_;                  ///< one per carrier
  std::vector<std::unique_ptr<ActionSet>> action_set_;  ///< one per vehicle, otherwise
  std::vector<ActionChoice> on_ground_;
  Goal goal_;
  std::optional<double> entropy_due_t_;  ///< s, next evaluation of the extended entropy
};

}  // namespace incognita
