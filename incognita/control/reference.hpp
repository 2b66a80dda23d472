// Paths in time for a controller to follow.
#pragma once

#include <Eigen/Core>

namespace incognita {

struct Reference {
  Eigen::Vector3d position{0, 0, 0};      ///< m
  Eigen::Vector3d velocity{0, 0, 0};      ///< m/s
  Eigen::Vector3d acceleration{0, 0, 0};  ///< m/s^2
  double heading = 0;                     ///< where to look, rad about z from +x; grows on through pi
  double heading_rate = 0;                ///< rad/s
  double heading_acceleration = 0;        ///< rad/s^2
};

/// From rest to rest along a line with the least jerk (Flash and Hogan, J. Neuroscience 1985). Before
/// `start_t` it stands at `from`, after `end_t` at `to`.
Reference minimum_jerk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double start_t, double end_t,
                       double t);

}  // namespace incognita
