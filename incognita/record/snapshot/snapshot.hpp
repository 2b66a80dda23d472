// One tick as files and screens see it: marginals only, immutable once published.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/status.hpp"
#include "incognita/vision/image.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

/// A landmark's own marginal. Anchors have zero covariance.
struct SnapshotLandmark {
  std::int64_t id = 0;
  bool anchor = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< world, m
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< m^2
  int detection_count = 0;                               ///< matches so far
};

struct SnapshotMatch {
  std::int64_t id = 0;
  bool anchor = false;
  bool line = false;  ///< depth not known yet: not in the map proper
  Eigen::Vector2d predicted =
      Eigen::Vector2d::Zero();  ///< px, before this frame's image was used; of a line, after
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Zero();  ///< px^2
  std::optional<Eigen::Vector2d> measured;                   ///< px, where the search found the patch
  double correlation = 0;                                    ///< normalised, of the best place found
  MatchOutcome outcome = MatchOutcome::not_searched;
  int vehicle = 0;          ///< of a team: which of them looked, from 0
  bool of_vehicle = false;  ///< at another of them, whose index is `id`; not at a landmark
};

inline const char* kind(const SnapshotMatch& match) {
  return match.of_vehicle ? "vehicle" : match.anchor ? "anchor" : match.line ? "line" : "landmark";
}

/// One vehicle of a team, as a body in space.
struct SnapshotVehicle {
  StampedPose estimate;
  PoseCovariance covariance = PoseCovariance::Zero();
  std::optional<StampedPose> truth;
  std::optional<Eigen::Vector4d> reference;  ///< x, y, z (m, world) and heading (rad): where it was to be
  SmallVector input;                         ///< until the next tick, as its motion takes it
};

struct SnapshotDecision {
  std::vector<std::string> actions;  ///< names, fixed for a run
  std::vector<double> scores;        ///< nats, one per action, of this frame
  int chosen = -1;                   ///< index; the action now in force
  bool decided = false;              ///< whether a decision was taken in this very frame
  std::optional<double> coverage;    ///< share of the place that was looked at, where more is expected there
  /// nats, of vehicle, map and what is expected and not mapped yet (Figure 6.3); of the last decision
  std::optional<double> entropy_extended;
};

struct SnapshotEntropy {  ///< nats; NaN where not known
  double vehicle, map, total;
};

struct Snapshot {
  Tick tick;
  std::optional<Truth> truth;
  std::shared_ptr<const Image> image;
  TrackingStatus status;
  /// Estimated camera state (5.24) and its 12x12 error covariance; meaningless while starting or lost.
  FreeCameraMotion::State<double> camera = FreeCameraMotion::State<double>::Zero();
  FreeCameraMotion::Jacobian covariance = FreeCameraMotion::Jacobian::Zero();
  std::vector<SnapshotLandmark> landmarks;  ///< mapped points and anchors
  std::vector<SnapshotMatch> matches;       ///< looks of this frame
  int predicted = 0;                        ///< looks tried (searched for) in this frame
  int matched = 0;                          ///< looks that updated the filter in this frame
  double nis = 0;                           ///< normalised innovation squared of this frame's update, a sum
  int nis_dof = 0;                          ///< its degrees of freedom; 0 when there was no update
  SnapshotEntropy entropy{};
  SnapshotDecision decision;
  Command command;
  std::vector<SnapshotVehicle> vehicles;  ///< of a team; `camera`, `covariance` and `truth` are the first's
  std::vector<std::pair<const char*, double>> timing_ms;  ///< stage -> ms, same order in every snapshot
};

}  // namespace incognita
