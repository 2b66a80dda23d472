// Limits of the velocity that a real robot is commanded with: of its size, and of its change from one command to the next.
#pragma once

#include <Eigen/Core>

#include "incognita/control/planar_command.hpp"

namespace incognita {

struct VelocityLimits {
  PlanarLimits velocity;
  double max_acceleration_m_s2 = 0.5;          ///< of the speed
  double max_angular_acceleration_rad_s2 = 1;  ///< of the turn rate

  /// Throws std::invalid_argument if a limit is not positive and finite.
  void check() const;
};

/// The velocity to command, `dt_s` after `last` was: speed, m/s, and turn rate, rad/s. `desired` is first scaled into the limits
/// as limited() does, and then approached from `last` as fast as the accelerations allow, each of the two numbers for itself. Zeros
/// if `desired` is not finite. Stopping for safety does not come here: it is immediate.
Eigen::Vector2d limited_velocity(const Eigen::Vector2d& desired, const Eigen::Vector2d& last, double dt_s,
                                 const VelocityLimits& limits);

}  // namespace incognita
