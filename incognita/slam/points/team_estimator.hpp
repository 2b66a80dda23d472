// Localization and mapping by any number of vehicles in one belief, thesis (5.16)-(5.19). Each vehicle has
// its own motion model and detects landmarks, with or without identity, and other team members. A single
// vehicle is a team of one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/messages/command.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// The reason why the settings are invalid; empty when they are valid.
std::string validate_team_settings(const TeamSettings& settings);

class TeamEstimator {
 public:
  using Estimate = TeamEstimate;

  /// Throws std::invalid_argument with the reason when the settings are invalid.
  explicit TeamEstimator(TeamSettings settings);

  const TeamSettings& settings() const { return settings_; }

  /// `observation.bodies` has one entry per vehicle, in the order of the members; throws std::invalid_argument
  /// when their number differs. Predicts each vehicle through its inputs to the time of the tick, then
  /// applies all inliers in one update.
  void update(TeamEstimate& estimate, const Command& command, const Observation& observation,
              const Tick& tick) const;

 private:
  void start(TeamEstimate& estimate, const Observation& observation, const Tick& tick) const;
  void update_poses(TeamEstimate& estimate) const;
  void refresh_entropy(TeamEstimate& estimate, double t) const;

  TeamSettings settings_;
};

}  // namespace incognita
