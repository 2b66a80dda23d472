// What can be set on the controller (5.29).
#pragma once

namespace incognita {

struct ControlSettings {
  double gain_position_per_s2 = 6.0;     ///< Q_2p of (5.29)
  double gain_velocity_per_s = 5.0;      ///< Q_2v
  double gain_orientation_per_s2 = 6.0;  ///< holds the gaze; (5.29) leaves it to the rate alone
  double gain_rate_per_s = 5.0;          ///< Q_2w
  double max_acceleration_m_s2 = 3.0;    ///< per axis, what the body can do
  double max_angular_acceleration_rad_s2 = 3.0;
  double gaze_amplitude_rad = 0.0;  ///< the gaze swings by this much to either side about the vertical
  double gaze_period_s = 20.0;      ///< of one full swing
};

}  // namespace incognita
