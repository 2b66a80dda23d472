// Choice of the translation and the gaze of a freely moving camera: thesis 6.3.1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/decision/action_choice.hpp"
#include "incognita/decision/body_choice.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

/// How the actions move a free camera.
/// `delay_s`: after which an operator begins a chosen action.
Mobility free_mobility(const DecisionSettings& settings, double delay_s);

class FreeCameraChoice final : public BodyChoice {
 public:
  /// Sigmas: of the unknown accelerations of the motion model. `who`: index in the team. `delay_s`: after which an operator
  /// begins a chosen action. Throws std::invalid_argument as ActionChoice and Translations do.
  FreeCameraChoice(const DecisionSettings& settings, double sigma_acceleration_m_s2,
                   double sigma_angular_acceleration_rad_s2, std::uint64_t seed, std::size_t who = 0,
                   double delay_s = 0);

  void choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
              const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) override;
  void forget() override;
  void state(StateArchive& archive) override;
  const std::vector<std::string>& names() const override { return choice_.names(); }

 private:
  void nod(double dt);
  void look_at(const GazeDirection& wanted, double dt);
  bool begin_to_look(const CameraState& camera, double dt);
  void compare_turns(const AnyBelief& belief, BlockId vehicle, const CameraState& camera,
                     const Expectation& expectation, double t);

  DecisionSettings settings_;
  Translations translations_;
  Turns turns_;
  ActionChoice choice_;
  LookAhead gaze_;
  bool looking_ = false;  ///< whether the heading is initialized
  double heading_rad_ = 0, heading_rate_rad_s_ = 0, gaze_t_ = 0;
  double elevation_rad_ = 0, elevation_rate_rad_s_ = 0;
};

}  // namespace incognita
