// Snapshots of a synthetic run: a camera on a circle, an estimate with small errors, two anchors, a growing
// map.
#pragma once

#include <cmath>
#include <limits>
#include <memory>

#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita::testing {

struct SyntheticRun {
  bool with_truth = true;
  int frames = 120;
  int starting = 3;  ///< first frames, without a pose
  int lost_from = 1 << 30, lost_to = 1 << 30;
  double sigma_position_m = 0.02, sigma_rotation_rad = 0.01;
  double error_factor = 1;  ///< ratio of the true errors to the sigmas

  TrackingState state(int frame) const {
    if (frame < starting) return TrackingState::starting;
    if (frame >= lost_from && frame < lost_to) return TrackingState::lost;
    return TrackingState::tracking;
  }
};

inline FreeCameraMotion::State<double> camera_on_circle(double t) {
  FreeCameraMotion::State<double> x = FreeCameraMotion::State<double>::Zero();
  x.segment<3>(0) << 1.5 * std::cos(0.4 * t), 1.5 * std::sin(0.4 * t), 1.3 + 0.2 * std::sin(t);
  x.segment<4>(3) = quaternion_exp<double>(Eigen::Vector3d(-1.2, 0.1, 0.4 * t));
  return x;
}

inline void add_map(Snapshot& snapshot, int mapped) {
  for (int i = 0; i < mapped + 2; ++i) {
    SnapshotLandmark landmark;
    landmark.id = i;
    landmark.anchor = i < 2;
    landmark.position << 3 * std::cos(0.9 * i), 3 * std::sin(0.9 * i), 0.3 * (i % 7);
    landmark.detection_count = static_cast<int>(snapshot.tick.frame);
    if (!landmark.anchor) {
      const Eigen::Vector3d away = landmark.position.normalized();
      landmark.covariance =
          0.0004 * Eigen::Matrix3d::Identity() + 0.02 / (1 + i % 5) * away * away.transpose();
    }
    snapshot.landmarks.push_back(landmark);
  }
}

inline void add_measurements(Snapshot& snapshot, RandomStream& random) {
  constexpr MatchOutcome outcomes[] = {MatchOutcome::matched, MatchOutcome::not_found, MatchOutcome::outlier,
                                       MatchOutcome::not_searched};
  for (int i = 0; i < 8; ++i) {
    SnapshotMatch match;
    match.id = i;
    match.anchor = i < 2;
    match.ray = i == 7;
    match.image = true;
    match.predicted << 40 + 35 * i, 60 + 20 * (i % 4);
    match.innovation_cov << 9 + i, 3, 3, 6;
    match.outcome = outcomes[i < 5 ? 0 : i - 4];
    if (match.outcome == MatchOutcome::matched || match.outcome == MatchOutcome::outlier)
      match.measured = match.predicted + Eigen::Vector2d(random.normal(), random.normal());
    match.correlation = 0.9;
    if (match.ray)
      match.particles = {{match.predicted + Eigen::Vector2d(0.06, -2), 0.6},
                         {match.predicted + Eigen::Vector2d(4.2, -1), 0.3994},
                         {match.predicted + Eigen::Vector2d(9, 1), 0.0006}};
    snapshot.matches.push_back(match);
  }
  snapshot.predicted = 7;
  snapshot.matched = 5;
  snapshot.nis_dof = 10;
  for (int i = 0; i < 10; ++i) snapshot.nis += std::pow(random.normal(), 2);
}

inline void add_pose(Snapshot& snapshot, const SyntheticRun& run, RandomStream& random) {
  const FreeCameraMotion::State<double> truth = camera_on_circle(snapshot.tick.t);
  SnapshotBody& body = snapshot.bodies.emplace_back();
  body.state = snapshot.status.state;
  body.estimate = {snapshot.tick.t, truth.head<3>(), truth.segment<4>(3)};
  if (run.with_truth) body.truth = body.estimate;
  for (int i = 0; i < 6; ++i) {
    const double sigma = i < 3 ? run.sigma_position_m : run.sigma_rotation_rad;
    body.covariance(i, i) = sigma * sigma;
  }
  Eigen::Vector3d shift, turn;
  for (int i = 0; i < 3; ++i) shift[i] = run.error_factor * run.sigma_position_m * random.normal();
  for (int i = 0; i < 3; ++i) turn[i] = run.error_factor * run.sigma_rotation_rad * random.normal();
  body.estimate.position += shift;
  body.estimate.orientation = quaternion_product<double>(truth.segment<4>(3), quaternion_exp(turn));
  body.velocity = truth.tail<6>();
  body.input.resize(6);
  body.input << 0.1, 0.2, -0.1, 0, 0, 0;
}

/// The first cells are seen, one more in each frame.
inline void add_exploration(Snapshot& snapshot) {
  ExplorationVolume volume{{-2, -1.5, 0}, {2, 1.5, 3.5}, 1, {4, 3, 7}, std::vector<std::uint8_t>(11)};
  for (std::size_t cell = 0; cell < 84 && cell <= static_cast<std::size_t>(snapshot.tick.frame); ++cell)
    volume.seen[cell / 8] |= static_cast<std::uint8_t>(1u << cell % 8);
  snapshot.exploration = std::make_shared<const ExplorationVolume>(volume);
}

inline void add_decision(SnapshotBody& body, int frame) {
  body.decision.actions = {"stay", "forward", "back", "left", "right", "up", "down"};
  for (int i = 0; i < 7; ++i) body.decision.scores.push_back(1 + std::sin(0.3 * frame / 30 + i));
  body.decision.decided = frame % 30 == 15;
  body.decision.chosen = (frame + 15) / 30 % 7;
}

inline Snapshot synthetic_snapshot(const SyntheticRun& run, int frame, double pace_ms = 5) {
  RandomStream random(static_cast<std::uint64_t>(frame), "synthetic run");
  Snapshot snapshot;
  snapshot.tick = {frame, frame / 30.0, frame == 0 ? 0 : 1 / 30.0};
  snapshot.status.state = run.state(frame);
  snapshot.status.reason = "5 of 7 features matched";
  add_pose(snapshot, run, random);
  add_map(snapshot, frame / 10);
  add_measurements(snapshot, random);
  add_exploration(snapshot);
  add_decision(snapshot.bodies.at(0), frame);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  snapshot.entropy = {-50.0 - 0.01 * frame, 3.0 * (frame / 10), -50 - 0.01 * frame + 3.0 * (frame / 10)};
  snapshot.mapped = 0.001 * frame;
  if (frame < run.starting) snapshot.entropy = {unknown, unknown, unknown};
  snapshot.timing_ms = {{"search", 0.5 * pace_ms}, {"frame", pace_ms}};
  if (frame == 20) snapshot.timing_ms.insert(snapshot.timing_ms.begin() + 1, {"birth", 1.0});
  return snapshot;
}

}  // namespace incognita::testing
