// Settings of the controller (5.29).
#pragma once

namespace incognita {

struct ControlSettings {
  double gain_position_per_s2 = 6.0;     ///< Q_2p of (5.29)
  double gain_velocity_per_s = 5.0;      ///< Q_2v
  double gain_orientation_per_s2 = 6.0;  ///< attitude gain; (5.29) has only the rate gain
  double gain_rate_per_s = 5.0;          ///< Q_2w
  double max_acceleration_m_s2 = 3.0;    ///< per axis; limit of the body
  double max_angular_acceleration_rad_s2 = 3.0;
  double gaze_amplitude_rad = 0.0;  ///< amplitude of the gaze's swing about the vertical
  double gaze_period_s = 20.0;      ///< duration of one full swing
};

}  // namespace incognita
