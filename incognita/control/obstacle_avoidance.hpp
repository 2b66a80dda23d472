// Obstacle avoidance below every command: the low level of thesis Section 6.4.3.
//
// A vehicle that is round about its axle approaches an obstacle at range r and bearing b (from its direction
// of travel) with v cos(b), for every turn rate. Limited to v cos(b) <= (r - radius) / T it approaches ever
// more slowly and never closer than its radius; T is chosen such that the full speed is available from
// `avoidance_distance_m` on. As the speed is reduced, the vehicle turns away.
#pragma once

#include <Eigen/Core>
#include <span>

#include "incognita/control/planar_command.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {

struct ObstacleAvoidanceSettings {
  double avoidance_distance_m = 0.8;  ///< distance from the axle's center within which it slows down
  double radius_m = 0.3;              ///< radius about the axle's center, with a margin
  PlanarLimits limits;

  /// Throws std::invalid_argument if `avoidance_distance_m` is not larger than the radius, or the limits are invalid.
  void check() const;
};

enum class TurnSide { none, left, right };

struct AvoidanceCommand {
  Eigen::Vector2d drive{0, 0};          ///< speed, m/s, and turn rate, rad/s, to the left
  TurnSide turn_side = TurnSide::none;  ///< side it turns to; passed to the next call, it stays fixed
};

/// Reduces `desired` (m/s, rad/s) by the obstacles in `ranges`; `turn_side` is the result of the previous call.
AvoidanceCommand avoid_obstacles(const Eigen::Vector2d& desired, std::span<const ConeRange> ranges,
                                 const ObstacleAvoidanceSettings& settings, TurnSide turn_side);

}  // namespace incognita
