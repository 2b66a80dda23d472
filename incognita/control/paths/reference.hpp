// Reference state of a controller.
#pragma once

#include <Eigen/Core>

namespace incognita {

struct Reference {
  Eigen::Vector3d position{0, 0, 0};      ///< m
  Eigen::Vector3d velocity{0, 0, 0};      ///< m/s
  Eigen::Vector3d acceleration{0, 0, 0};  ///< m/s^2
  double heading = 0;                     ///< rad about z from +x; not wrapped
  double heading_rate = 0;                ///< rad/s
  double heading_acceleration = 0;        ///< rad/s^2
};

/// Minimum-jerk motion along a line, from rest to rest (Flash and Hogan, J. Neuroscience 1985). Stands at
/// `from` before `start_t` and at `to` after `end_t`.
Reference minimum_jerk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double start_t, double end_t,
                       double t);

}  // namespace incognita
