// Where a camera that moves freely goes next, and how it turns meanwhile: thesis 6.3.1.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incognita/decision/action_choice.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/models/camera_measurement.hpp"

namespace incognita {

class FreeCameraChoice {
 public:
  /// `period_s` and the like from the settings; sigmas: of the accelerations that nobody commanded;
  /// `who`: which of its team. Throws std::invalid_argument as ActionChoice and Translations do.
  FreeCameraChoice(const DecisionSettings& settings, double sigma_acceleration_m_s2,
                   double sigma_angular_acceleration_rad_s2, std::uint64_t seed, std::size_t who = 0);

  /// Scores, chosen, from, to, times and gaze of the goal. `camera`: where the camera is believed to be.
  template <class Form>
  void choose(const Form& belief, BlockId vehicle, const CameraState& camera, const Expectation& expectation,
              const Tick& tick, Goal& goal);

  /// After the estimate was lost.
  void forget();

  const std::vector<std::string>& names() const { return choice_.names(); }

 private:
  template <class Form>
  void turn(const Form& belief, BlockId vehicle, const CameraState& camera, const Expectation& expectation,
            const Tick& tick);

  DecisionSettings settings_;
  Translations translations_;
  Turns turns_;
  ActionChoice choice_;
  LookAhead gaze_;
  bool looking_ = false;  ///< whether there is a heading yet
  double heading_rad_ = 0, heading_rate_rad_s_ = 0, gaze_t_ = 0;
};

}  // namespace incognita
