// How a vehicle that carries a camera drives on: by which change of its speeds most is learnt, thesis 6.4.2.
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

/// What carries a camera: a vehicle with two driven wheels.
struct CarrierSettings {
  Mount mount;
  double max_speed_m_s = 1;
  double max_turn_rate_rad_s = 1;
};

class VehicleChoice {
 public:
  /// Sigmas: of the accelerations that the filter's motion, which knows of no wheels, takes for noise. Throws
  /// std::invalid_argument as ActionChoice and SpeedChanges do.
  VehicleChoice(const DecisionSettings& settings, const CarrierSettings& carrier,
                double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2, std::uint64_t seed,
                std::size_t who = 0);

  /// Scores, chosen, times, from, to and drive of the goal. `camera`: where the camera is believed to be.
  /// `wheels`: speed, m/s, and turn rate, rad/s, as the encoders tell; without them as they were told to
  /// turn. The filter does not know of them, the choice does: thesis 6.4.2.
  template <class Form>
  void choose(const Form& belief, BlockId vehicle, const CameraState& camera,
              const std::optional<Eigen::Vector2d>& wheels, const Expectation& expectation, const Tick& tick,
              Goal& goal);

  /// After the estimate was lost: it stands.
  void forget();

  const std::vector<std::string>& names() const { return choice_.names(); }

 private:
  SpeedChanges changes_;
  ActionChoice choice_;
  Eigen::Vector2d drive_{0, 0};
};

}  // namespace incognita
