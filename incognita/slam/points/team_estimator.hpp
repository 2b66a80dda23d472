// Localisation and mapping by any number of vehicles in one belief, thesis (5.16)-(5.19): each moves by its
// own model, sees landmarks, with names or without, and the others of its team. One vehicle is a team too.
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

/// Why these cannot be; empty when they can.
std::string validate_team_settings(const TeamSettings& settings);

class TeamEstimator {
 public:
  using Estimate = TeamEstimate;

  /// Throws std::invalid_argument with the fault.
  explicit TeamEstimator(TeamSettings settings);

  const TeamSettings& settings() const { return settings_; }

  /// `observation.bodies`: one for each vehicle, in their order; throws std::invalid_argument when there are
  /// others. Each vehicle is predicted through what it told to the tick's time; then all sightings are used
  /// at once.
  void update(TeamEstimate& estimate, const Command& command, const Observation& observation,
              const Tick& tick) const;

 private:
  void start(TeamEstimate& estimate, const Observation& observation, const Tick& tick) const;
  void update_poses(TeamEstimate& estimate) const;
  void refresh_entropy(TeamEstimate& estimate, double t) const;

  TeamSettings settings_;
};

}  // namespace incognita
