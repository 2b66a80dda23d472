// A vehicle that keeps clear of what stands around it, whatever it is told to do: the low level of thesis
// Section 6.4.3.
//
// A vehicle that is round about its axle closes in on a thing at range r and bearing b off its way with
// v cos(b), however it turns. Held to v cos(b) <= (r - radius) / T it comes near, ever slower, and never
// nearer than its radius; T is such that it has its full speed from `avoidance_distance_m` on. What speed it loses it
// turns away by.
#pragma once

#include <Eigen/Core>
#include <span>

#include "incognita/control/planar_command.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {

struct ObstacleAvoidanceSettings {
  double avoidance_distance_m = 0.8;  ///< from the middle of the axle; nearer, it is slower
  double radius_m = 0.3;              ///< of the vehicle about there, with something to spare
  PlanarLimits limits;

  /// Throws std::invalid_argument where `avoidance_distance_m` is not more than the radius, or the limits cannot be.
  void check() const;
};

enum class TurnSide { none, left, right };

struct AvoidanceCommand {
  Eigen::Vector2d drive{0, 0};  ///< speed, m/s, and turn rate, rad/s, to the left
  TurnSide turn_side =
      TurnSide::none;  ///< to which it turns away; told to the next call, it does not change its mind
};

/// What is left of `desired`; `away` is what the call before answered.
AvoidanceCommand avoid_obstacles(const Eigen::Vector2d& desired, std::span<const ConeRange> ranges,
                                 const ObstacleAvoidanceSettings& settings, TurnSide turn_side);

}  // namespace incognita
