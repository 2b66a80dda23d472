// The decision: the chosen action of every body, and the predicted information gain of every candidate.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "incognita/messages/exploration_volume.hpp"

namespace incognita {

/// A person drives the body: shares of its largest velocity, -1 to 1.
struct ManualDrive {
  Eigen::Vector3d direction{0, 0, 0};  ///< forward, left, up, relative to the heading
  double turn = 0;                     ///< positive to the left
};

/// Goal of one body.
struct BodyGoal {
  std::vector<double> scores;     ///< predicted information gain, nats, one per action, when last evaluated
  int chosen = -1;                ///< index of the current action; -1 before the first decision and when lost
  bool decided = false;           ///< chosen in this tick
  Eigen::Vector3d from{0, 0, 0};  ///< world, m: start of the action
  Eigen::Vector3d to{0, 0, 0};    ///< world, m: end of the action
  double start_t = 0;             ///< s
  double end_t = 0;
  std::optional<double> heading_rad = {};  ///< at the end of the action, rad from +x about z; none: free
  double heading_rate_rad_s = 0;           ///< rate of heading_rad, positive to the left
  double elevation_rad = 0;                ///< of the optical axis above the horizon, with heading_rad
  double elevation_rate_rad_s = 0;
  /// A vehicle driven by velocity instead of a target position: speed, m/s, and turn rate, rad/s, positive to the left.
  std::optional<Eigen::Vector2d> drive = {};
  std::optional<ManualDrive> manual = {};  ///< taken over by a person, whatever else is set
};

struct Goal {
  std::vector<BodyGoal> bodies;  ///< one per body, in their order; empty where nothing is decided

  /// Exploration prior, where the scenario has one (Figure 6.3).
  std::optional<double> coverage = {};                        ///< viewed share of the exploration volume
  std::optional<double> entropy_extended = {};                ///< nats, of bodies, map and expected landmarks
  std::shared_ptr<const ExplorationVolume> exploration = {};  ///< replaced when a cell becomes seen
};

}  // namespace incognita
