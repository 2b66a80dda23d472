#include "incognita/control/keep_clear.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "incognita/math/angles.hpp"

namespace incognita {
namespace {

/// The bearing of a cone's middle from the way the vehicle goes, which backwards is behind it.
double off_the_way(const ConeRange& cone, bool backwards) {
  return wrap_angle(cone.bearing_rad + (backwards ? std::numbers::pi : 0));
}

/// The farther side, by what is ahead on either.
Side freer_side(std::span<const ConeRange> around, bool backwards) {
  double left = 0, right = 0;
  for (const ConeRange& cone : around) {
    const double b = off_the_way(cone, backwards);
    if (std::abs(b) < std::numbers::pi / 2) (b > 0 ? left : right) += cone.range_m;
  }
  return left >= right ? Side::left : Side::right;
}

}  // namespace

void KeepClear::check() const {
  limits.check();
  if (!(radius_m >= 0) || !(keep_clear_m > radius_m) || !std::isfinite(keep_clear_m))
    throw std::invalid_argument("a vehicle must keep clear by more than its radius");
}

ClearDrive kept_clear(const Eigen::Vector2d& wanted, std::span<const ConeRange> around,
                      const KeepClear& settings, Side away) {
  const double speed = std::abs(wanted[0]);
  const bool backwards = wanted[0] < 0;
  const double per_s = settings.limits.max_speed_m_s / (settings.keep_clear_m - settings.radius_m);
  double allowed = speed;
  for (const ConeRange& cone : around) {
    // As straight ahead as the thing may be inside its cone
    const double b = std::max(0.0, std::abs(off_the_way(cone, backwards)) - cone.half_width_rad);
    if (b >= std::numbers::pi / 2) continue;
    const double closing = std::max(0.0, cone.range_m - settings.radius_m) * per_s;
    allowed = std::min(allowed, closing / std::cos(b));
  }
  if (!(allowed < speed)) return {wanted, Side::none};
  if (away == Side::none) away = freer_side(around, backwards);
  const double lost = 1 - allowed / speed;
  const double turn = (away == Side::left ? 1 : -1) * settings.limits.max_turn_rate_rad_s;
  return {{std::copysign(allowed, wanted[0]), (1 - lost) * wanted[1] + lost * turn}, away};
}

}  // namespace incognita
