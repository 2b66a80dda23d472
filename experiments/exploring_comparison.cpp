#include "experiments/exploring_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "incognita/analysis/evaluation/median.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita::exploring {
namespace {

using Eigen::Vector3d;

/// Scores in frames that choose nothing would only take time.
Sets sets_of(const Strategy& strategy) {
  Sets sets = strategy.sets;
  const bool scheduled =
      std::ranges::any_of(sets, [](const std::string& s) { return s.starts_with("decision.schedule"); });
  if (!scheduled) sets.push_back("decision.schedule=at-decisions");
  return sets;
}

}  // namespace

std::vector<Strategy> with(const Sets& sets, std::vector<Strategy> strategies) {
  for (Strategy& strategy : strategies) strategy.sets.insert(strategy.sets.end(), sets.begin(), sets.end());
  return strategies;
}

Runs runs_of(const std::string& scenario, const Strategy& strategy, const ExperimentSettings& settings,
             std::uint64_t first) {
  if (settings.report)
    settings.report(fmt::format("  {}, {}: {} runs", scenario, strategy.name, settings.seeds));
  return {
      over_seeds(settings.seeds,
                 [&](std::uint64_t seed) { return explore(scenario, sets_of(strategy), first - 1 + seed); }),
      strategy.name};
}

std::vector<Runs> runs_of_all(const std::string& scenario, const std::vector<Strategy>& strategies,
                              const ExperimentSettings& settings, std::uint64_t first) {
  std::vector<Runs> all;
  for (const Strategy& strategy : strategies) all.push_back(runs_of(scenario, strategy, settings, first));
  return all;
}

ExperimentSettings half_of(ExperimentSettings settings) {
  settings.seeds = (settings.seeds + 1) / 2;
  return settings;
}

bool diverged(const Run& run) { return run.outcome.diverged.value_or(true); }

int diverged_of(const Runs& runs) { return static_cast<int>(std::ranges::count_if(runs, diverged)); }

int kept_of(const Runs& runs) { return static_cast<int>(runs.size()) - diverged_of(runs); }

Answer stays_localized(const Runs& runs) { return happens_in(0.9, kept_of(runs), runs.size()); }

ClaimNumber share_localized(const Runs& runs) {
  return {"share of rooms in which it stays localized",
          share_of(static_cast<std::size_t>(kept_of(runs)), runs.size())};
}

double entropy_at_the_14th(const Run& run) { return run.extended_when_located(14).value_or(std::nan("")); }

double time_until_the_14th(const Run& run) { return run.located_at_s(14).value_or(run.end_s); }

int runs_without_14(const Runs& runs) {
  return static_cast<int>(std::ranges::count_if(runs, [](const Run& run) { return !run.located_at_s(14); }));
}

double share_inside_2_sigma(const Run& run) {
  double inside = 0, all = 0;
  for (const Instant& i : run.instants) {
    const Vector3d error = i.truth.position - i.estimate.position;
    for (int axis = 0; axis < 3; ++axis)
      inside += std::abs(error[axis]) <= 2 * std::sqrt(i.covariance(axis, axis)), ++all;
  }
  return inside / all;
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

double returns(const Run& run) {
  double count = 0;
  for (const Decision& d : run.decisions) count += d.returned;
  return count;
}

Interval median_known(std::vector<double> numbers) {
  std::erase_if(numbers, [](double x) { return !std::isfinite(x); });
  return median_interval(std::move(numbers));
}

/// Entropy and share seen only with an exploration prior, since they are of its volume.
std::string in_numbers(const Runs& runs) {
  const auto mean = [&](const auto& of) { return bootstrap_mean(each(runs, of)).value; };
  const bool prior = std::isfinite(mean(&Run::coverage));
  const std::string entropy = prior ? fmt::format("entropy {} nats, ", decimals(mean(final_entropy), 0)) : "",
                    seen = prior ? fmt::format("{:.0f} % seen, ", 100 * mean(&Run::coverage)) : "";
  return fmt::format("{}: {}position error {} m, {} diverged, {}{:.1f} located", runs.name, entropy,
                     decimals(median_known(each(runs, &Run::position_rms_m)).value, 3), diverged_of(runs),
                     seen, mean(located));
}

std::string in_numbers(const std::vector<Runs>& runs) {
  std::string all;
  for (const Runs& one : runs) all += (all.empty() ? "" : "; ") + in_numbers(one);
  return all;
}

}  // namespace incognita::exploring
