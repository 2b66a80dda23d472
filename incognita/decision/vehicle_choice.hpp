// Choice of the speed change of a vehicle that carries a camera, by information gain: thesis 6.4.2.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/action_choice.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/models/camera_measurement.hpp"
#include "incognita/models/mount.hpp"

namespace incognita {

/// The vehicle that carries a camera; it has two driven wheels.
struct CarrierSettings {
  Mount mount;
  double max_speed_m_s = 1;
  double max_turn_rate_rad_s = 1;
};

class VehicleChoice {
 public:
  /// Sigmas: acceleration noise of the filter's motion model, which has no wheel model. Throws
  /// std::invalid_argument as ActionChoice and SpeedChanges do.
  VehicleChoice(const DecisionSettings& settings, const CarrierSettings& carrier,
                double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2, std::uint64_t seed,
                std::size_t who = 0);

  /// Sets scores, chosen, times, from, to and drive of the goal. `camera`: the estimated camera state.
  /// `wheels`: speed (m/s) and turn rate (rad/s) from the encoders; if empty, the last command is used. Only
  /// the decision uses them, not the filter: thesis 6.4.2.
  void choose(const AnyBelief& belief, BlockId vehicle, const CameraState& camera,
              const std::optional<Eigen::Vector2d>& wheels, const Expectation& expectation, const Tick& tick,
              Goal& goal);

  /// To be called when tracking is lost: the commanded speeds are set to zero.
  void forget();

  const std::vector<std::string>& names() const { return choice_.names(); }

 private:
  SpeedChanges changes_;
  ActionChoice choice_;
  Eigen::Vector2d drive_{0, 0};
};

}  // namespace incognita
