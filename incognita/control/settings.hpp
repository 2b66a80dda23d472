// Settings of the controller of a body in space (5.29).
#pragma once

#include "incognita/math/setting.hpp"

namespace incognita {

struct ControlSettings {
  double gain_position_per_s2 = 6.0;
  double gain_velocity_per_s = 5.0;
  double gain_orientation_per_s2 = 6.0;
  double gain_rate_per_s = 5.0;
  double max_acceleration_m_s2 = 3.0;
  double max_angular_acceleration_rad_s2 = 3.0;
  double gaze_amplitude_rad = 0.0;
  double gaze_period_s = 20.0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = ControlSettings;
    setting(&S::gain_position_per_s2, "gain_position_per_s2", "1/s^2", at_least(0),
            "Gain on the position error, Q_2p of (5.29)");
    setting(&S::gain_velocity_per_s, "gain_velocity_per_s", "1/s", at_least(0),
            "Gain on the velocity error, Q_2v of (5.29)");
    setting(&S::gain_orientation_per_s2, "gain_orientation_per_s2", "1/s^2", at_least(0),
            "Gain on the orientation error; (5.29) has only the gain on the angular rate");
    setting(&S::gain_rate_per_s, "gain_rate_per_s", "1/s", at_least(0),
            "Gain on the angular rate error, Q_2w of (5.29)");
    setting(&S::max_acceleration_m_s2, "max_acceleration_m_s2", "m/s^2", at_least(0),
            "Limit of the acceleration, per axis");
    setting(&S::max_angular_acceleration_rad_s2, "max_angular_acceleration_rad_s2", "rad/s^2", at_least(0),
            "Limit of the angular acceleration, per axis");
    setting(&S::gaze_amplitude_rad, "swing_amplitude_rad", "rad", between(0, 3.2),
            "Amplitude of the swinging gaze about the vertical");
    setting(&S::gaze_period_s, "swing_period_s", "s", between(0.001, 1e6), "Period of the swinging gaze");
  }
};

}  // namespace incognita
