#include "incognita/app/loop/snapshot_parts.hpp"

#include <algorithm>
#include <string_view>

namespace incognita {

StageTimes timing_of(const StageTimes& measured, std::span<const char* const> in_estimator,
                     const StageTimes& loop_ms) {
  StageTimes timing;
  double frame = 0;
  for (const auto& [stage, ms] : loop_ms) {
    const std::string_view name = stage;
    if (name != "estimator") timing.emplace_back(stage, ms);
    if (name == "estimator" || name == "advice" || name == "control") frame += ms;
  }
  for (const char* stage : in_estimator) {
    const auto found = std::find_if(measured.begin(), measured.end(), [&](const auto& entry) {
      return std::string_view(entry.first) == stage;
    });
    timing.emplace_back(stage, found == measured.end() ? 0.0 : found->second);
  }
  timing.emplace_back("frame", frame);
  return timing;
}

SnapshotDecision snapshot_decision(const Goal& goal, const std::vector<std::string>& actions) {
  SnapshotDecision decision;
  decision.actions = actions;
  decision.scores = goal.scores;
  decision.chosen = goal.chosen;
  decision.decided = goal.decided;
  decision.coverage = goal.coverage;
  decision.entropy_extended = goal.entropy_extended;
  return decision;
}

void put_update(Snapshot& s, const UpdateReport& update, const Entropy& entropy) {
  if (update.outcome == UpdateReport::Outcome::updated) {
    s.nis = update.nis;
    s.nis_dof = update.rows;
  }
  s.entropy = {entropy.vehicle, entropy.map, entropy.total};
}

}  // namespace incognita
