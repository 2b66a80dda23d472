// When a landmark on a surface can be expected: from where it would be seen, and for how long.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace incognita {

/// Sine of the angle to a surface from which a landmark on it can be matched.
inline constexpr double least_sine_to_surface = 0.5;

/// Whether `camera` sees a surface at `position` (world, m) well enough; always without a normal (zero).
inline bool sees_surface(const Eigen::Vector3d& camera, const Eigen::Vector3d& position,
                         const Eigen::Vector3d& normal) {
  return normal.isZero() ||
         normal.dot(camera - position) >= least_sine_to_surface * (camera - position).norm();
}

/// Probability that a landmark is still to be mapped where none was in `seen_s` of view; 0 where it is not worth looking any more.
inline double still_there(double seen_s, double patience_s) {
  constexpr double least = 0.02;
  const double probability = std::exp(-seen_s / patience_s);
  return probability < least ? 0 : probability;
}

}  // namespace incognita
