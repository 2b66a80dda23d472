// Angles in radians.
#pragma once

#include <cmath>
#include <numbers>

namespace incognita {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

/// The same direction in (-pi, pi]. `S` is any scalar with floor() and arithmetic with double.
template <class S>
S wrap_angle(const S& angle) {
  using std::floor;
  const S turns = floor((angle + S(std::numbers::pi)) / S(2 * std::numbers::pi));
  const S wrapped = angle - turns * S(2 * std::numbers::pi);
  return wrapped <= S(-std::numbers::pi) ? wrapped + S(2 * std::numbers::pi) : wrapped;
}

}  // namespace incognita
