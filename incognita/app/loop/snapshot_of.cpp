#include "incognita/app/loop/snapshot_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "incognita/app/loop/snapshot_parts.hpp"

namespace incognita {
namespace {

std::vector<SnapshotLandmark> landmarks_of(const Estimate& estimate) {
  std::vector<SnapshotLandmark> landmarks;
  for (const Landmark& landmark : estimate.catalog) {
    if (landmark.kind == Landmark::Kind::line) continue;
    const auto at = position_of(landmark, estimate.belief);
    if (!at) continue;
    landmarks.push_back({landmark.id, landmark.kind == Landmark::Kind::anchor, at->position, at->covariance,
                         landmark.matches});
  }
  return landmarks;
}

std::vector<SnapshotMatch> matches_of(const Estimate& estimate) {
  std::vector<SnapshotMatch> matches;
  for (const FeatureMatch& match : estimate.matches)
    matches.push_back({match.id, match.kind == Landmark::Kind::anchor, false, match.predicted,
                       match.innovation_cov, match.measured, match.correlation, match.outcome});
  for (const LineMatch& match : estimate.line_matches)
    matches.push_back({match.id, false, true, match.predicted, match.innovation_cov, match.measured,
                       match.correlation, match.outcome});
  return matches;
}

constexpr std::array camera_stages{"sums",      "start",  "predict", "search", "planes",
                                   "consensus", "update", "lines",   "births", "map"};
}  // namespace

Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& observation,
                     const Estimate& estimate, const Goal& goal, const std::vector<std::string>& actions,
                     const Command& command, const std::vector<std::pair<const char*, double>>& loop_ms) {
  Snapshot s;
  s.tick = tick;
  s.truth = truth;
  s.image = of_first_body(observation).image;
  s.status = estimate.status;
  if (estimate.started) {
    s.camera = estimate.camera_state();
    s.covariance = estimate.belief.covariance(estimate.camera);
  }
  s.landmarks = landmarks_of(estimate);
  s.matches = matches_of(estimate);
  s.predicted = estimate.predicted;
  s.matched = estimate.matched;
  put_update(s, estimate.update, estimate.entropy);
  s.decision = snapshot_decision(goal, actions);
  s.command = command;
  s.timing_ms = timing_of(estimate.timing_ms, camera_stages, loop_ms);
  return s;
}

}  // namespace incognita
