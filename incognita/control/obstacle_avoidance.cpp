#include "incognita/control/obstacle_avoidance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "incognita/math/angles.hpp"

namespace incognita {
namespace {

/// Bearing of a cone's center from the direction of travel, which is behind the vehicle when it reverses.
double off_the_way(const ConeRange& cone, bool backwards) {
  return wrap_angle(cone.bearing_rad + (backwards ? std::numbers::pi : 0));
}

/// Side with the larger sum of ranges in the direction of travel.
TurnSide freer_side(std::span<const ConeRange> ranges, bool backwards) {
  double left = 0, right = 0;
  for (const ConeRange& cone : ranges) {
    const double b = off_the_way(cone, backwards);
    if (std::abs(b) < std::numbers::pi / 2) (b > 0 ? left : right) += cone.range_m;
  }
  return left >= right ? TurnSide::left : TurnSide::right;
}

}  // namespace

void ObstacleAvoidanceSettings::check() const {
  limits.check();
  if (!(radius_m >= 0) || !(avoidance_distance_m > radius_m) || !std::isfinite(avoidance_distance_m))
    throw std::invalid_argument("a vehicle must keep clear by more than its radius");
}

AvoidanceCommand avoid_obstacles(const Eigen::Vector2d& desired, std::span<const ConeRange> ranges,
                                 const ObstacleAvoidanceSettings& settings, TurnSide turn_side) {
  const double speed = std::abs(desired[0]);
  const bool backwards = desired[0] < 0;
  const double per_s = settings.limits.max_speed_m_s / (settings.avoidance_distance_m - settings.radius_m);
  double allowed = speed;
  for (const ConeRange& cone : ranges) {
    // Smallest bearing that the obstacle may have inside its cone
    const double b = std::max(0.0, std::abs(off_the_way(cone, backwards)) - cone.half_width_rad);
    if (b >= std::numbers::pi / 2) continue;
    const double closing = std::max(0.0, cone.range_m - settings.radius_m) * per_s;
    allowed = std::min(allowed, closing / std::cos(b));
  }
  if (!(allowed < speed)) return {desired, TurnSide::none};
  if (turn_side == TurnSide::none) turn_side = freer_side(ranges, backwards);
  const double lost = 1 - allowed / speed;
  const double turn = (turn_side == TurnSide::left ? 1 : -1) * settings.limits.max_turn_rate_rad_s;
  return {{std::copysign(allowed, desired[0]), (1 - lost) * desired[1] + lost * turn}, turn_side};
}

}  // namespace incognita
