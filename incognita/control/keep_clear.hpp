// A vehicle that keeps clear of what stands around it, whatever it is told to do: the low level of thesis
// Section 6.4.3.
//
// A vehicle that is round about its axle closes in on a thing at range r and bearing b off its way with
// v cos(b), however it turns. Held to v cos(b) <= (r - radius) / T it comes near, ever slower, and never
// nearer than its radius; T is such that it has its full speed from `keep_clear_m` on. What speed it loses it
// turns away by.
#pragma once

#include <Eigen/Core>
#include <span>

#include "incognita/control/planar_command.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {

struct KeepClear {
  double keep_clear_m = 0.8;  ///< from the middle of the axle; nearer, it is slower
  double radius_m = 0.3;      ///< of the vehicle about there, with something to spare
  PlanarLimits limits;

  /// Throws std::invalid_argument where `keep_clear_m` is not more than the radius, or the limits cannot be.
  void check() const;
};

enum class Side { none, left, right };

struct ClearDrive {
  Eigen::Vector2d drive{0, 0};  ///< speed, m/s, and turn rate, rad/s, to the left
  Side away = Side::none;  ///< to which it turns away; told to the next call, it does not change its mind
};

/// What is left of `wanted`; `away` is what the call before answered.
ClearDrive kept_clear(const Eigen::Vector2d& wanted, std::span<const ConeRange> around,
                      const KeepClear& settings, Side away);

}  // namespace incognita
