#include "experiments/exploring_run.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/app/assemble_team.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/record/exploration_summary.hpp"

namespace incognita::exploring {
namespace {

Decision decision_of(const Snapshot& s) {
  Decision d{s.tick.t, s.advice.actions.at(static_cast<std::size_t>(s.advice.chosen)), s.advice.scores,
             s.advice.entropy_extended.value_or(std::nan(""))};
  return d;
}

void add_instant(Run& run, const Snapshot& s, double& squares, double& nees) {
  const SnapshotVehicle& v = s.vehicles.front();
  Instant i{s.tick.t, *v.truth, v.estimate, v.covariance, s.entropy, 0};
  for (const SnapshotLandmark& l : s.landmarks) i.landmarks += !l.anchor;
  run.instants.push_back(i);
  squares += (v.truth->position - v.estimate.position).squaredNorm();
  nees += pose_nees(pose_error(*v.truth, v.estimate), v.covariance).value_or(std::nan(""));
}

}  // namespace

std::optional<double> Run::located_at_s(int count) const {
  if (count < 1 || count > static_cast<int>(located_t_s.size())) return std::nullopt;
  return located_t_s[static_cast<std::size_t>(count - 1)];
}

std::optional<double> Run::entropy_when_located(int count) const {
  const auto t = located_at_s(count);
  if (!t) return std::nullopt;
  const auto at = std::find_if(instants.begin(), instants.end(), [&](const Instant& i) {
    return i.t_s >= *t && std::isfinite(i.entropy.total);
  });
  return at == instants.end() ? std::nullopt : std::optional(at->entropy.total);
}

Run explore(const std::string& scenario, const Sets& sets, std::uint64_t seed) {
  Sets all = sets;
  all.push_back("run.seed=" + std::to_string(seed));
  TeamAssembly assembly = assemble_team(load_scenario(scenario, all));
  Run run;
  ExplorationSummary summary;
  double squares = 0, nees = 0;
  run_loop(assembly.boxes, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
             summary.add(s);
             add_instant(run, s, squares, nees);
             run.map = s.landmarks;
             run.lost = s.status.state == TrackingState::lost;
             if (s.advice.decided && s.advice.chosen >= 0) run.decisions.push_back(decision_of(s));
           }),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  const auto ticks = static_cast<double>(run.instants.size());
  run.position_rms_m = std::sqrt(squares / ticks);
  run.nees = nees / ticks;
  run.coverage = summary.coverage().value_or(std::nan(""));
  run.entropy_extended = summary.entropy_extended().value_or(std::nan(""));
  for (int count = 1; count <= summary.located(); ++count)
    run.located_t_s.push_back(*summary.located_t_s(count));
  return run;
}

}  // namespace incognita::exploring
