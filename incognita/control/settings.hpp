// The control laws, and their settings.
#pragma once

#include <vector>

#include "incognita/math/setting.hpp"
#include "incognita/models/motion/motion_model.hpp"

namespace incognita {

enum class ControlLaw {
  none,      ///< a constant input
  tracking,  ///< of a moving reference
  lqg,       ///< linear quadratic regulator to a point
  feedback_linearization,
  active  ///< follows the goals of a decision, thesis Chapter 6, by the usual law of the motion; the last
};

/// The point of a vehicle that a law brings to its path: the center of the axle, or a point off it (5.13), which can be
/// moved sideways.
constexpr bool steers_axle(ControlLaw law) {
  switch (law) {
    case ControlLaw::none:
    case ControlLaw::tracking:
      return true;
    case ControlLaw::lqg:
    case ControlLaw::feedback_linearization:
    case ControlLaw::active:
      break;
  }
  return false;
}

/// Parameters of the control laws of vehicles. A diagonal matrix is given by one common number or by one per entry.
struct LawSettings {
  std::vector<double> gain_per_s{0.5};
  double control_point_m = 0.2;
  double gain_along_per_s = 1, gain_across_per_m2 = 4, gain_heading_per_m = 2;
  std::vector<double> weight_state{1}, weight_input{1};

  static void describe(auto&& setting) {
    using namespace limits;
    using S = LawSettings;
    setting(&S::gain_per_s, "gain_per_s", "1/s", any(),
            "Gain on the position error, one or per axis, Q_2 of (5.9)");
    setting(&S::control_point_m, "control_point_m", "m", between(-1000, 1000),
            "Control point on uneven ground, ahead of the axle; not 0");
    setting(&S::gain_along_per_s, "gain_along_per_s", "1/s", any(),
            "Gain on the longitudinal error, Kanayama's K_x");
    setting(&S::gain_across_per_m2, "gain_across_per_m2", "1/m^2", any(), "Gain on the lateral error, K_y");
    setting(&S::gain_heading_per_m, "gain_heading_per_m", "1/m", any(),
            "Gain on the sine of the heading error, K_theta");
    setting(&S::weight_state, "weight_state", "", any(),
            "Diagonal of the state weight Q_1 of (5.1); one number: all the same");
    setting(&S::weight_input, "weight_input", "", any(),
            "Diagonal of the input weight Q_2 of (5.1); one number: all the same");
  }

  /// Calls `use` with each member that the law of that motion uses.
  static void used_by(ControlLaw law, const MotionTraits& motion, auto&& use) {
    using S = LawSettings;
    const bool linearizes = law == ControlLaw::feedback_linearization || law == ControlLaw::active;
    const bool tracks = law == ControlLaw::tracking;
    if (law == ControlLaw::lqg) use(&S::weight_state), use(&S::weight_input);
    if (motion.in_space()) return;  // the gains of ControlSettings
    if (linearizes || (tracks && motion.on_line())) use(&S::gain_per_s);
    if (linearizes && motion.space == Space::uneven_ground) use(&S::control_point_m);
    if (tracks && !motion.on_line())
      use(&S::gain_along_per_s), use(&S::gain_across_per_m2), use(&S::gain_heading_per_m);
  }
};

/// Of a body in space (5.29), and of the gaze of a free camera.
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
    setting(&S::max_acceleration_m_s2, "max_acceleration_m_s2", "m/s^2", more_than(0),
            "Limit of the acceleration, per axis");
    setting(&S::max_angular_acceleration_rad_s2, "max_angular_acceleration_rad_s2", "rad/s^2", more_than(0),
            "Limit of the angular acceleration, per axis");
    setting(&S::gaze_amplitude_rad, "swing_amplitude_rad", "rad", between(0, 3.2),
            "Amplitude of the swinging gaze about the vertical");
    setting(&S::gaze_period_s, "swing_period_s", "s", between(0.001, 1e6), "Period of the swinging gaze");
  }
};

}  // namespace incognita
