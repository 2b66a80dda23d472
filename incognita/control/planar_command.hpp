// What a planar vehicle is asked to do, within what it can do.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace incognita {

/// Both positive and finite: a command that is held for a while is only safe when the turn rate has a limit.
struct PlanarLimits {
  double max_speed_m_s = 1;        ///< of the middle of the axle, forwards and backwards
  double max_turn_rate_rad_s = 1;  ///< to either side

  /// Throws std::invalid_argument.
  void check() const {
    if (!(max_speed_m_s > 0) || !std::isfinite(max_speed_m_s))
      throw std::invalid_argument("the speed limit must be positive and finite");
    if (!(max_turn_rate_rad_s > 0) || !std::isfinite(max_turn_rate_rad_s))
      throw std::invalid_argument("the turn rate limit must be positive and finite");
  }
};

struct PlanarCommand {
  double speed_m_s = 0;        ///< of the middle of the axle
  double turn_rate_rad_s = 0;  ///< positive to the left
  bool saturated = false;      ///< less than what was wanted

  /// As DifferentialDrive takes it.
  Eigen::Vector2d input() const { return {speed_m_s, turn_rate_rad_s}; }
};

/// Speed and turn rate shrunk by the same factor: every point of the body keeps its direction of motion.
inline PlanarCommand limited(const Eigen::Vector2d& desired, const PlanarLimits& limits) {
  const double excess = std::max(std::abs(desired[0]) / limits.max_speed_m_s,
                                 std::abs(desired[1]) / limits.max_turn_rate_rad_s);
  if (!(excess > 1)) return {desired[0], desired[1], false};
  // The clamp is for the last bit of the division
  return {std::clamp(desired[0] / excess, -limits.max_speed_m_s, limits.max_speed_m_s),
          std::clamp(desired[1] / excess, -limits.max_turn_rate_rad_s, limits.max_turn_rate_rad_s), true};
}

}  // namespace incognita
