// Which action, which way, and what every candidate would have taught.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace incognita {

/// Where one vehicle of a team is to go.
struct VehicleGoal {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};  ///< world, m, from `start_t` to `end_t` of the goal
  double heading_rad = 0;                      ///< about z from +x
  double heading_rate_rad_s = 0;               ///< to the left
  std::optional<Eigen::Vector2d> drive = {};   ///< instead of a place: as Goal::drive
};

struct Goal {
  std::vector<double> scores;  ///< nats of information, one per action, as last compared
  int chosen = -1;             ///< index of the action in force; -1 before the first decision and when lost
  bool decided = false;        ///< whether it was chosen in this very frame
  Eigen::Vector3d from{0, 0, 0};  ///< world, m: where the action starts
  Eigen::Vector3d to{0, 0, 0};    ///< and where it is to end
  double start_t = 0;             ///< s
  double end_t = 0;
  std::optional<double> heading_rad =
      {};                         ///< where a camera is to look now, about z from +x; none: as it will
  double heading_rate_rad_s = 0;  ///< and how fast that turns, to the left
  /// Of a vehicle that is told how to drive, not where to: speed, m/s, and turn rate, rad/s, to the left
  std::optional<Eigen::Vector2d> drive = {};

  /// Of what is not mapped yet, where such is expected (Figure 6.3)
  std::optional<double> coverage = {};          ///< share of the place that was looked at
  std::optional<double> entropy_extended = {};  ///< nats, of map and vehicle with those not mapped yet
  std::vector<VehicleGoal> team = {};
};

}  // namespace incognita
