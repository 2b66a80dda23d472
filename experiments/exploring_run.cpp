#include "experiments/exploring_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/association_score.hpp"
#include "incognita/record/snapshot/series.hpp"
#include "incognita/record/summary/exploration_summary.hpp"
#include "incognita/record/summary/run_info.hpp"

namespace incognita::exploring {
namespace {

Decision decision_of(const Snapshot& s) {
  const SnapshotDecision& of = s.bodies.front().decision;
  Decision d{
      s.tick.t,         of.chosen, chosen_action(of), of.scores, s.entropy_extended.value_or(std::nan("")),
      s.entropy.vehicle};
  for (const SnapshotLandmark& l : s.landmarks)
    if (!l.anchor) d.mapped.push_back(l.id);
  return d;
}

/// Gathers a run from its snapshots.
class Gathered {
 public:
  explicit Gathered(const RunInfo& info) : outcome_(same_frame_as_truth(info)) {}

  void add(const Snapshot& s) {
    summary_.add(s);
    outcome_.add(s);
    run_.map = s.landmarks;
    run_.end_s = s.tick.t;
    const SnapshotBody& body = s.bodies.at(0);
    run_.actions = body.decision.actions;
    note_returned(s);
    if (body.decision.decided && body.decision.chosen >= 0) {
      run_.decisions.push_back(decision_of(s));
      run_.decisions.back().returned = std::exchange(returned_, 0);
      run_.decisions.back().longest_away_s = std::exchange(longest_away_s_, 0);
    }
    if (has_pose(body) && body.truth) add_instant(s);
  }

  Run finish() {
    const auto ticks = static_cast<double>(run_.instants.size());
    run_.outcome = outcome_.measures();
    run_.position_rms_m = run_.outcome.position_rms_m.value_or(std::nan(""));
    run_.nees = nees_ / ticks;
    run_.coverage = summary_.coverage().value_or(std::nan(""));
    run_.entropy_extended = summary_.entropy_extended().value_or(std::nan(""));
    for (int count = 1; count <= summary_.located(); ++count)
      run_.located_t_s.push_back(*summary_.located_t_s(count));
    return std::move(run_);
  }

 private:
  void add_instant(const Snapshot& s) {
    const SnapshotBody& body = s.bodies.front();
    Instant i{s.tick.t,  *body.truth,         body.estimate, body.covariance,
              s.entropy, mapped_landmarks(s), s.matched};
    if (body.velocity) i.velocity = body.velocity->head<3>();
    nees_ += pose_nees(pose_error(i.truth, i.estimate), i.covariance).value_or(std::nan(""));
    run_.instants.push_back(std::move(i));
  }

  void note_returned(const Snapshot& s) {
    for (const SnapshotMatch& match : s.matches) {
      if (match.outcome != MatchOutcome::matched || match.anchor) continue;
      const auto [last, first] = matched_t_s_.try_emplace(match.id, s.tick.t);
      const double away = s.tick.t - last->second;
      if (!first && away > away_s) ++returned_, longest_away_s_ = std::max(longest_away_s_, away);
      last->second = s.tick.t;
    }
  }

  Run run_;
  ExplorationSummary summary_;
  OutcomeSummary outcome_;
  std::map<std::int64_t, double> matched_t_s_;  ///< when last, by landmark
  int returned_ = 0;                            ///< since the last decision
  double longest_away_s_ = 0;
  double nees_ = 0;
};

Run gather(Assembly assembly) {
  Gathered gathered(assembly.info);
  std::optional<AssociationScore> score;
  if (assembly.association_truth) score.emplace(assembly.association_truth);
  const auto publish = [&](const Snapshot& s) {
    gathered.add(s);
    if (score) score->add(s);
  };
  run_loop(assembly.parts, std::function<void(const Snapshot&)>(publish),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  Run run = gathered.finish();
  if (score) run.matches_right = score->right(), run.matches_wrong = score->wrong();
  return run;
}

/// A number of the first element from `t_s` on at which it is known.
template <class Element, class Of>
std::optional<double> first_known(const std::vector<Element>& elements, std::optional<double> t_s,
                                  const Of& of) {
  for (const Element& e : elements)
    if (t_s && e.t_s >= *t_s && std::isfinite(of(e))) return of(e);
  return std::nullopt;
}

}  // namespace

std::optional<double> Run::located_at_s(int count) const {
  if (count < 1 || count > static_cast<int>(located_t_s.size())) return std::nullopt;
  return located_t_s[static_cast<std::size_t>(count - 1)];
}

std::optional<double> Run::entropy_when_located(int count) const {
  return first_known(instants, located_at_s(count), [](const Instant& i) { return i.entropy.total; });
}

std::optional<double> Run::extended_when_located(int count) const {
  return first_known(decisions, located_at_s(count), [](const Decision& d) { return d.entropy_extended; });
}

Run explore(const std::string& scenario, const Sets& sets, std::uint64_t seed,
            const std::function<void(Assembly&)>& change) {
  Sets all = sets;
  all.push_back("run.seed=" + std::to_string(seed));
  Assembly assembly = assemble(load_scenario(scenario, all));
  if (change) change(assembly);
  return gather(std::move(assembly));
}

}  // namespace incognita::exploring
