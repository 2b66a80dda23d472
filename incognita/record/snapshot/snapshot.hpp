// One tick as recorded and displayed: marginals only, immutable once published.
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

/// A landmark with its marginal covariance. Anchors have zero covariance.
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
  bool line = false;                                    ///< depth not converged, not yet in the map
  Eigen::Vector2d predicted = Eigen::Vector2d::Zero();  ///< px, prior to this update; if `line`, after it
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Zero();  ///< px^2
  std::optional<Eigen::Vector2d> measured;                   ///< px, where the search found the patch
  double correlation = 0;                                    ///< normalized correlation at the best match
  MatchOutcome outcome = MatchOutcome::not_searched;
  int vehicle = 0;          ///< of a team: the measuring vehicle, from 0
  bool of_vehicle = false;  ///< the target is another vehicle with index `id`, not a landmark
};

inline const char* kind(const SnapshotMatch& match) {
  return match.of_vehicle ? "vehicle" : match.anchor ? "anchor" : match.line ? "line" : "landmark";
}

/// One vehicle of a team, as a rigid body in space.
struct SnapshotVehicle {
  StampedPose estimate;
  PoseCovariance covariance = PoseCovariance::Zero();
  std::optional<StampedPose> truth;
  std::optional<Eigen::Vector4d> reference;  ///< x, y, z (m, world), heading (rad)
  SmallVector input;                         ///< applied until the next tick, as its motion model takes it
};

struct SnapshotDecision {
  std::vector<std::string> actions;  ///< names, constant over a run
  std::vector<double> scores;        ///< nats, one per action, of this frame
  int chosen = -1;                   ///< index of the action in force
  bool decided = false;              ///< whether a decision was made in this frame
  std::optional<double> coverage;    ///< viewed share of the exploration volume
  /// Entropy in nats of vehicle, map and expected unmapped landmarks (Figure 6.3), from the last decision.
  std::optional<double> entropy_extended;
};

struct SnapshotEntropy {  ///< nats; NaN if unknown
  double vehicle, map, total;
};

struct Snapshot {
  Tick tick;
  std::optional<Truth> truth;
  std::shared_ptr<const Image> image;
  TrackingStatus status;
  /// Estimated camera state (5.24) and its 12x12 error covariance; invalid while starting or lost.
  FreeCameraMotion::State<double> camera = FreeCameraMotion::State<double>::Zero();
  FreeCameraMotion::Jacobian covariance = FreeCameraMotion::Jacobian::Zero();
  std::vector<SnapshotLandmark> landmarks;  ///< mapped points and anchors
  std::vector<SnapshotMatch> matches;       ///< feature matches of this frame
  int predicted = 0;                        ///< features searched for in this frame
  int matched = 0;                          ///< matches used by the filter in this frame
  double nis = 0;                           ///< normalized innovation squared of this frame's update, summed
  int nis_dof = 0;                          ///< degrees of freedom of `nis`; 0 without an update
  SnapshotEntropy entropy{};
  SnapshotDecision decision;
  Command command;
  std::vector<SnapshotVehicle> vehicles;  ///< of a team; the first equals `camera`, `covariance`, `truth`
  std::vector<std::pair<const char*, double>> timing_ms;  ///< stage -> ms, same order in every snapshot
};

}  // namespace incognita
