// Choice of the speed change of a vehicle that carries a camera, by information gain: thesis 6.4.2.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/decision/action_choice.hpp"
#include "incognita/decision/body_choice.hpp"
#include "incognita/models/motion/mount.hpp"

namespace incognita {

/// The vehicle that carries a camera; it has two driven wheels.
struct CarrierSettings {
  Mount mount;
  double max_speed_m_s = 1;
  double max_turn_rate_rad_s = 1;
  double clearance_m =
      0;  ///< distance to keep from obstacles that are read, m; 0: they are left to the controller
};

/// How the actions move that vehicle.
Mobility mobility_of(const DecisionSettings& settings, const CarrierSettings& carrier);

class CarrierChoice final : public BodyChoice {
 public:
  /// Sigmas: acceleration noise of the filter's motion model, which has no wheel model. Throws
  /// std::invalid_argument as ActionChoice and SpeedChanges do.
  CarrierChoice(const DecisionSettings& settings, const CarrierSettings& carrier,
                double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2, std::uint64_t seed,
                std::size_t who = 0);

  /// The speeds are those of `body.wheels`, from the encoders; without them, of the last command. Only the decision uses
  /// them, not the filter: thesis 6.4.2.
  void choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
              const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) override;
  /// The commanded speeds are set to zero.
  void forget() override;
  void state(StateArchive& archive) override;
  const std::vector<std::string>& names() const override { return choice_.names(); }

 private:
  SpeedChanges changes_;
  ActionChoice choice_;
  Eigen::Vector2d drive_{0, 0};
};

}  // namespace incognita
