#include "incognita/app/loop/snapshot_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "incognita/app/loop/snapshot_parts.hpp"

namespace incognita {
namespace {

std::vector<SnapshotLandmark> landmarks_of(const Estimate& estimate) {
  std::vector<SnapshotLandmark> landmarks;
  for (const Landmark& landmark : estimate.catalogue) {
    if (landmark.kind == Landmark::Kind::line) continue;
    const auto at = position_of(landmark, estimate.belief);
    if (!at) continue;
    landmarks.push_back({landmark.id, landmark.kind == Landmark::Kind::anchor, at->position, at->covariance,
                         landmark.matches});
  }
  return landmarks;
}

std::vector<SnapshotLook> looks_of(const Estimate& estimate) {
  std::vector<SnapshotLook> looks;
  for (const Look& look : estimate.looks)
    looks.push_back({look.id, look.kind == Landmark::Kind::anchor, false, look.predicted, look.innovation_cov,
                     look.measured, look.correlation, look.outcome});
  for (const LineLook& look : estimate.line_looks)
    looks.push_back({look.id, false, true, look.predicted, look.innovation_cov, look.measured,
                     look.correlation, look.outcome});
  return looks;
}

constexpr std::array camera_stages{"sums",      "start",  "predict", "search", "planes",
                                   "consensus", "update", "lines",   "births", "map"};
constexpr std::array planar_stages{"predict", "associate", "update", "births", "decorrelate", "entropy"};

/// Errors of a planar pose are x, y and the turn about z, which is the same in world and body axes.
void put_planar_pose(Snapshot& s, const PlanarPoseEstimate& vehicle) {
  const double half = vehicle.pose[2] / 2;
  s.camera.head<7>() << vehicle.pose[0], vehicle.pose[1], 0, std::cos(half), 0, 0, std::sin(half);
  constexpr int at[] = {0, 1, 5};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s.covariance(at[i], at[j]) = vehicle.covariance(i, j);
}

SnapshotLandmark in_space(const PlanarLandmark& landmark, const PlanarEstimate& estimate) {
  const PlanarPosition at = position_of(landmark, estimate);
  SnapshotLandmark out{
      landmark.id, landmark.anchor, {at.position.x(), at.position.y(), 0}, {}, landmark.sightings};
  out.covariance.setZero();
  out.covariance.topLeftCorner<2, 2>() = at.covariance;
  return out;
}

}  // namespace

Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& seen,
                     const Estimate& estimate, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms) {
  Snapshot s;
  s.tick = tick;
  s.truth = truth;
  s.image = seen.image;
  s.status = estimate.status;
  if (estimate.started) {
    s.camera = estimate.camera_state();
    s.covariance = estimate.belief.covariance(estimate.camera);
  }
  s.landmarks = landmarks_of(estimate);
  s.looks = looks_of(estimate);
  s.predicted = estimate.predicted;
  s.matched = estimate.matched;
  put_update(s, estimate.update, estimate.entropy);
  s.advice = advice_of(goal, actions);
  s.command = command;
  s.timing_ms = timing_of(estimate.timing_ms, camera_stages, loop_ms);
  return s;
}

Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation&,
                     const PlanarEstimate& estimate, const Goal&, const std::vector<std::string>&,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms) {
  Snapshot s;
  s.tick = tick;
  s.truth = truth;
  s.status = estimate.status;
  if (estimate.started) put_planar_pose(s, vehicle_pose(estimate));
  for (const PlanarLandmark& landmark : estimate.catalogue)
    s.landmarks.push_back(in_space(landmark, estimate));
  for (const PlanarLook& look : estimate.looks)
    s.looks.push_back(
        {look.id, look.anchor, false, look.predicted, look.innovation_cov, look.measured, 0, look.outcome});
  s.predicted = static_cast<int>(estimate.looks.size());
  s.matched = estimate.matched;
  put_update(s, estimate.update, estimate.entropy);
  s.command = command;
  s.timing_ms = timing_of(estimate.timing_ms, planar_stages, loop_ms);
  return s;
}

}  // namespace incognita
