// One tick as recorded and displayed: marginals only, immutable once published.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/messages/exploration_volume.hpp"
#include "incognita/messages/intervention.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/mapper/status.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

/// A landmark with its marginal covariance. Anchors have zero covariance.
struct SnapshotLandmark {
  std::int64_t id = 0;
  bool anchor = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< world, m
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< m^2
  int detection_count = 0;                               ///< matches so far
  std::optional<Eigen::Vector3d> truth = {};             ///< its true position, where a simulation knows it
};

/// A depth hypothesis of a ray, as predicted in the image.
struct SnapshotParticle {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double weight = 0;  ///< its probability before this match; those out of view are omitted
};

/// A measurement with its association. Of a measurement with more components the first two: of an image px, else m and
/// rad in the coordinates of the sensor.
struct SnapshotMatch {
  std::int64_t id = 0;
  bool anchor = false;
  bool ray = false;                                     ///< depth not converged, not yet in the map
  Eigen::Vector2d predicted = Eigen::Vector2d::Zero();  ///< before this update; of a ray, after it
  Eigen::Matrix2d innovation_cov = Eigen::Matrix2d::Zero();
  std::optional<Eigen::Vector2d> measured;  ///< none where the search found nothing
  double correlation = 0;                   ///< of an image: normalized correlation at the best match
  MatchOutcome outcome = MatchOutcome::not_searched;
  int body = 0;                             ///< the measuring body, from 0
  int sensor = 0;                           ///< which of the point sensors of the body, or of all cameras
  bool image = false;                       ///< measured by a camera in its image
  bool of_body = false;                     ///< the target is another body with index `id`, not a landmark
  std::vector<SnapshotParticle> particles;  ///< of a ray in an image
};

inline const char* kind(const SnapshotMatch& match) {
  return match.of_body ? "body" : match.anchor ? "anchor" : match.ray ? "ray" : "landmark";
}

/// The decision for one body.
struct SnapshotDecision {
  std::vector<std::string> actions;  ///< names, constant over a run
  std::vector<double> scores;        ///< nats, one per action, of this frame
  int chosen = -1;                   ///< index of the action in force
  bool decided = false;              ///< whether a decision was made in this frame
};

/// The name of the action in force; empty without one.
inline std::string chosen_action(const SnapshotDecision& decision) {
  const auto chosen = static_cast<std::size_t>(decision.chosen);
  return decision.chosen >= 0 && chosen < decision.actions.size() ? decision.actions[chosen] : "";
}

/// One body, as a rigid body in space.
struct SnapshotBody {
  TrackingState state = TrackingState::starting;
  StampedPose estimate;  ///< invalid while starting or lost
  PoseCovariance covariance = PoseCovariance::Zero();
  std::optional<StampedPose> truth;
  /// A free camera: estimated velocity (m/s, world) and angular rate (rad/s, camera axes)
  std::optional<Eigen::Matrix<double, 6, 1>> velocity;
  std::optional<Eigen::Vector4d> reference;  ///< x, y, z (m, world), heading (rad)
  SmallVector input;                         ///< commanded until the next tick, as its motion model takes it
  bool operator_controlled = false;          ///< an operator moves it, as the display shows
  bool manual = false;                       ///< a person drives it
  SnapshotDecision decision;
};

/// Keyframes of the only body that bundle adjustment estimated again in this frame.
struct SnapshotKeyframes {
  StampedPose before;  ///< the pose of this frame, before that
  Trajectory poses;    ///< in time order; the last is that of this frame
};

struct SnapshotEntropy {  ///< nats; NaN if unknown
  double vehicle, map, total;
  double t = std::numeric_limits<double>::quiet_NaN();  ///< s, the time that map and total stand for
};

struct Snapshot {
  Tick tick;
  std::shared_ptr<const Image> image;  ///< of the first camera of the first body
  TrackingStatus status;
  std::vector<SnapshotBody> bodies;
  std::vector<SnapshotLandmark> landmarks;  ///< mapped points and anchors
  std::vector<SnapshotMatch> matches;       ///< of this frame
  int predicted = 0;                        ///< measurements predicted in this frame
  int matched = 0;                          ///< matches used by the filter in this frame
  double nis = 0;                           ///< normalized innovation squared of this frame's update, summed
  int nis_dof = 0;                          ///< degrees of freedom of `nis`; 0 without an update
  std::optional<SnapshotKeyframes> keyframes;
  std::optional<Readout> readout;  ///< of a rolling shutter, if the residuals of a camera show one
  SnapshotEntropy entropy{};
  std::optional<double> coverage;  ///< viewed share of the exploration volume
  /// Share of the true world that the map contains to 5 cm: mapped_share.hpp. Where a simulation knows it.
  std::optional<double> mapped;
  /// Entropy in nats of vehicle, map and expected unmapped landmarks (Figure 6.3), from the last decision.
  std::optional<double> entropy_extended;
  std::vector<Intervention> interventions;                ///< that took effect before the motion of this tick
  std::shared_ptr<const ExplorationVolume> exploration;   ///< null without an exploration prior
  std::vector<std::pair<const char*, double>> timing_ms;  ///< stage -> ms, same order in every snapshot
};

/// The matches in the image that a snapshot holds: of the first camera of the first body.
inline std::vector<SnapshotMatch> matches_of_first_camera(const Snapshot& snapshot) {
  std::vector<SnapshotMatch> matches;
  for (const SnapshotMatch& match : snapshot.matches) {
    if (!match.image || match.body != 0) continue;
    if (!matches.empty() && match.sensor < matches.front().sensor) matches.clear();
    if (matches.empty() || match.sensor == matches.front().sensor) matches.push_back(match);
  }
  return matches;
}

}  // namespace incognita
