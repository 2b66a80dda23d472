#include "incognita/app/snapshot_of.hpp"

#include <algorithm>
#include <array>
#include <string_view>

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

/// Every snapshot has the same stages in the same order, zero where one was not reached.
std::vector<std::pair<const char*, double>> timing_of(
    const Estimate& estimate, const std::vector<std::pair<const char*, double>>& loop_ms) {
  static constexpr std::array in_estimator{"sums",      "start",  "predict", "search", "planes",
                                           "consensus", "update", "lines",   "births", "map"};
  std::vector<std::pair<const char*, double>> timing;
  double frame = 0;
  for (const auto& [stage, ms] : loop_ms) {
    const std::string_view name = stage;
    if (name != "estimator") timing.emplace_back(stage, ms);
    if (name == "estimator" || name == "advice" || name == "control") frame += ms;
  }
  for (const char* stage : in_estimator) {
    const auto found =
        std::find_if(estimate.timing_ms.begin(), estimate.timing_ms.end(),
                     [&](const auto& entry) { return std::string_view(entry.first) == stage; });
    timing.emplace_back(stage, found == estimate.timing_ms.end() ? 0.0 : found->second);
  }
  timing.emplace_back("frame", frame);
  return timing;
}

}  // namespace

Snapshot snapshot_of(const Tick& tick, const std::optional<Truth>& truth, const Observation& seen,
                     const Estimate& estimate, const Goal& goal, const std::vector<Translation>& actions,
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
  if (estimate.update.outcome == UpdateReport::Outcome::updated) {
    s.nis = estimate.update.nis;
    s.nis_dof = estimate.update.rows;
  }
  s.entropy = {estimate.entropy.vehicle, estimate.entropy.map, estimate.entropy.total};
  for (const Translation& action : actions) s.advice.actions.push_back(action.name);
  s.advice.scores = goal.scores;
  s.advice.chosen = goal.chosen;
  s.advice.decided = goal.decided;
  s.command = command;
  s.timing_ms = timing_of(estimate, loop_ms);
  return s;
}

}  // namespace incognita
