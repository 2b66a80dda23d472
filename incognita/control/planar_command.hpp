// Command of a planar vehicle, and its limits.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace incognita {

/// Both limits are positive and finite: a held command is safe only if the turn rate is limited.
struct PlanarLimits {
  double max_speed_m_s = 1;        ///< at the axle's center, forwards and backwards
  double max_turn_rate_rad_s = 1;  ///< to either side

  /// Throws std::invalid_argument if a limit is not positive and finite.
  void check() const {
    if (!(max_speed_m_s > 0) || !std::isfinite(max_speed_m_s))
      throw std::invalid_argument("the speed limit must be positive and finite");
    if (!(max_turn_rate_rad_s > 0) || !std::isfinite(max_turn_rate_rad_s))
      throw std::invalid_argument("the turn rate limit must be positive and finite");
  }
};

struct PlanarCommand {
  double speed_m_s = 0;        ///< at the axle's center
  double turn_rate_rad_s = 0;  ///< positive to the left
  bool saturated = false;      ///< whether it was scaled down

  /// Input of DifferentialDrive.
  Eigen::Vector2d input() const { return {speed_m_s, turn_rate_rad_s}; }
};

/// Scales speed and turn rate by the same factor to fit the limits: every point of the body keeps its
/// direction of motion.
inline PlanarCommand limited(const Eigen::Vector2d& desired, const PlanarLimits& limits) {
  const double excess = std::max(std::abs(desired[0]) / limits.max_speed_m_s,
                                 std::abs(desired[1]) / limits.max_turn_rate_rad_s);
  if (!(excess > 1)) return {desired[0], desired[1], false};
  // The clamp removes the rounding of the division
  return {std::clamp(desired[0] / excess, -limits.max_speed_m_s, limits.max_speed_m_s),
          std::clamp(desired[1] / excess, -limits.max_turn_rate_rad_s, limits.max_turn_rate_rad_s), true};
}

}  // namespace incognita
