#include "incognita/control/velocity_limits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace incognita {

void VelocityLimits::check() const {
  velocity.check();
  if (!(max_acceleration_m_s2 > 0 && std::isfinite(max_acceleration_m_s2)))
    throw std::invalid_argument("the acceleration limit must be positive and finite");
  if (!(max_angular_acceleration_rad_s2 > 0 && std::isfinite(max_angular_acceleration_rad_s2)))
    throw std::invalid_argument("the angular acceleration limit must be positive and finite");
}

Eigen::Vector2d limited_velocity(const Eigen::Vector2d& desired, const Eigen::Vector2d& last, double dt_s,
                                 const VelocityLimits& limits) {
  if (!desired.allFinite()) return {0, 0};
  const Eigen::Vector2d aim = limited(desired, limits.velocity).input();
  const Eigen::Vector2d from = last.allFinite() ? last : Eigen::Vector2d(0, 0);
  const double dt = std::isfinite(dt_s) ? std::max(dt_s, 0.0) : 0;
  const Eigen::Array2d step(limits.max_acceleration_m_s2 * dt, limits.max_angular_acceleration_rad_s2 * dt);
  const Eigen::Array2d most(limits.velocity.max_speed_m_s, limits.velocity.max_turn_rate_rad_s);
  const Eigen::Array2d changed = aim.array().max(from.array() - step).min(from.array() + step);
  return changed.max(-most).min(most);  // `last` may have been given with other limits
}

}  // namespace incognita
