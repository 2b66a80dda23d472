#include "experiments/exploring_comparison.hpp"

#include <limits>
#include <utility>

#include "experiments/common.hpp"
#include "incognita/analysis/evaluation/median.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita::exploring {
namespace {

/// Scores in frames that choose nothing would only take time.
Sets sets_of(const Strategy& strategy) {
  Sets sets = strategy.sets;
  const bool scheduled =
      std::ranges::any_of(sets, [](const std::string& s) { return s.starts_with("decision.schedule"); });
  if (!scheduled) sets.push_back("decision.schedule=at-decisions");
  return sets;
}

/// Share of the path that was driven backward.
double share_backwards(const Run& run) {
  double back = 0, all = 0;
  for (std::size_t i = 1; i < run.instants.size(); ++i) {
    const StampedPose &from = run.instants[i - 1].truth, &to = run.instants[i].truth;
    const Vector3d ahead = rotation_matrix<double>(from.orientation).col(2);
    const double way = (to.position - from.position).dot(ahead);
    back += std::max(0.0, -way);
    all += std::abs(way);
  }
  return all > 0 ? back / all : std::nan("");
}

/// Of those that are numbers, with its interval.
Interval median_known(std::vector<double> numbers) {
  std::erase_if(numbers, [](double x) { return !std::isfinite(x); });
  return median_interval(std::move(numbers));
}

std::ptrdiff_t lost_of(const Runs& runs) {
  return std::ranges::count_if(runs, [](const Run& r) { return r.outcome.lost; });
}

std::ptrdiff_t diverged_of(const Runs& runs) { return std::ranges::count_if(runs, diverged); }

/// Not a number for a run that diverged: the entropy of one that was lost is that of its last decision, too
/// high, and the entropy of one with such an error is overconfident.
double entropy_if_not_diverged(const Run& run) { return diverged(run) ? std::nan("") : final_entropy(run); }

double typically_off_m(const Runs& runs) { return median_of_known(each(runs, &Run::position_rms_m)); }

}  // namespace

Runs runs_of(const std::string& scenario, const Strategy& strategy, const ExperimentSettings& settings,
             std::uint64_t first) {
  if (settings.report)
    settings.report(fmt::format("  {}, {}: {} runs", scenario, strategy.name, settings.seeds));
  return over_seeds(settings.seeds, [&](std::uint64_t seed) {
    return explore(scenario, sets_of(strategy), first - 1 + seed);
  });
}

std::vector<Runs> runs_of_all(const std::string& scenario, const std::vector<Strategy>& strategies,
                              const ExperimentSettings& settings, std::uint64_t first) {
  std::vector<Runs> all;
  for (const Strategy& strategy : strategies) all.push_back(runs_of(scenario, strategy, settings, first));
  return all;
}

bool diverged(const Run& run) { return run.outcome.diverged.value_or(true); }

ExperimentSettings half_of(ExperimentSettings settings) {
  settings.seeds = (settings.seeds + 1) / 2;
  return settings;
}

double median_of_known(std::vector<double> numbers) { return median_known(std::move(numbers)).value; }

std::string in_numbers(const std::string& name, const Runs& runs) {
  // A run that never located so many did so after all others
  const auto located_14 = [](const Run& r) {
    return r.located_at_s(14).value_or(std::numeric_limits<double>::infinity());
  };
  const auto located = [](const Run& r) { return static_cast<double>(r.located_t_s.size()); };
  const Interval t_14 = median_interval(each(runs, located_14));
  constexpr double overconfident = 3;
  return fmt::format(
      "{}: entropy {}, position error {} m (median), NEES {} (median; above {} in {}), {} located, {} % "
      "covered, 14th after {}, {} lost",
      name, text(bootstrap_mean(each(runs, final_entropy))),
      text(median_known(each(runs, &Run::position_rms_m))),
      decimals(median_of_known(each(runs, &Run::nees)), 2), overconfident,
      std::ranges::count_if(runs, [](const Run& r) { return r.nees > overconfident; }),
      text(bootstrap_mean(each(runs, located))),
      text(bootstrap_mean(each(runs, [](const Run& r) { return 100 * r.coverage; }))),
      std::isfinite(t_14.value) ? text(t_14, "s") + " (median)" : "the end of most runs", lost_of(runs));
}

double share_across(const Run& run) {
  double across = 0, along = 0;
  for (const Decision& d : run.decisions) {
    if (d.action == "go_forward" || d.action == "go_backwards")
      ++along;
    else if (d.action != "stay")
      ++across;
  }
  return across / (across + along);
}

Claim backs_away(const std::string& id, const std::string& place, const std::string& printed,
                 const std::string& start, const Runs& runs, const std::string& why,
                 const std::string& variant) {
  const std::vector<double> beyond_half =
      less(each(runs, share_backwards), std::vector<double>(runs.size(), 0.5));
  const Interval more = bootstrap_mean(beyond_half, assessed_at);
  int slower = 0, faster = 0;
  for (const Run& run : runs)
    for (const Decision& d : run.decisions) {
      slower += d.action.starts_with("slower");
      faster += d.action.starts_with("faster");
    }
  return assessed(
      id, place,
      "The vehicle explores by repeatedly choosing a negative linear acceleration: more than half of its "
      "path is driven backward, starting " +
          start + variant,
      {.printed = printed,
       .measured = {"share backward less a half: {} (99.9 %); {} decisions for slower, {} for faster",
                    text(more), slower, faster},
       .why = why,
       .seeds = beyond_half.size()},
      is_above(more, 0));
}

Claim beats(const std::string& id, const std::string& place, const std::string& statement,
            const std::string& what, const Runs& ours, const Runs& theirs, const std::string& why) {
  const std::vector<double> all = less(each(ours, final_entropy), each(theirs, final_entropy));
  const std::size_t found =
      less(each(ours, entropy_if_not_diverged), each(theirs, entropy_if_not_diverged)).size();
  const Interval gap = more_than(theirs, ours, final_entropy),
                 gap_if_found = more_than(theirs, ours, entropy_if_not_diverged);
  const auto better = std::ranges::count_if(all, [](double d) { return d < 0; });
  const std::size_t left_out = ours.size() - all.size();
  std::string measured = fmt::format(
      "entropy less that of {}: {} nats (99.9 %), lower in {} of {} rooms{}", what, text(gap), better,
      all.size(), left_out > 0 ? fmt::format(", {} with nothing to compare", left_out) : "");
  if (found < all.size())
    measured += fmt::format("; in the {} in which neither diverged {} nats", found, text(gap_if_found));
  measured += fmt::format("; diverged {} and {}, position error {} and {} m (median)", diverged_of(ours),
                          diverged_of(theirs), decimals(typically_off_m(ours), 3),
                          decimals(typically_off_m(theirs), 3));
  const Finding in_all = is_below(gap, 0), in_found = is_below(gap_if_found, 0);
  Claim claim = assessed(id, place, statement, {.measured = measured, .why = why, .seeds = all.size()},
                         in_all && in_found);
  if (claim.verdict == Verdict::undecided && claim.runs >= claim.least_runs && in_all == Finding::shown)
    claim.why = "shown for all rooms; among those in which neither diverged the interval holds both answers";
  return claim;
}

}  // namespace incognita::exploring
