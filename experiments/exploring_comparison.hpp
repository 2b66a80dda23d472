// Exploration strategies run over many rooms, and numbers of their runs, for Sections 6.3 and 6.4.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/compared_numbers.hpp"
#include "experiments/evidence.hpp"
#include "experiments/exploring_run.hpp"
#include "experiments/seeds.hpp"
#include "incognita/analysis/evaluation/statistics.hpp"
#include "incognita/report/experiment.hpp"

namespace incognita::exploring {

/// A choice of translations and gaze.
struct Strategy {
  std::string name;  ///< as in `less that of NAME`
  Sets sets;
};

/// The same strategies with these settings, too.
std::vector<Strategy> with(const Sets& sets, std::vector<Strategy> strategies);

/// Runs of one strategy, by seed.
struct Runs : std::vector<Run> {
  std::string name;  ///< of the strategy
};

/// The first room that was not used to choose settings.
inline constexpr std::uint64_t fresh_rooms = 101;

/// Runs of a scenario by that strategy, settings.seeds of them from `first` on. Frames that choose nothing
/// score nothing, unless the strategy says so.
Runs runs_of(const std::string& scenario, const Strategy& strategy, const ExperimentSettings& settings,
             std::uint64_t first = 1);

/// The same by several strategies, one after the other.
std::vector<Runs> runs_of_all(const std::string& scenario, const std::vector<Strategy>& strategies,
                              const ExperimentSettings& settings, std::uint64_t first = 1);

/// Settings with half the seeds.
ExperimentSettings half_of(ExperimentSettings settings);

/// What of(run) of `ours` is more than that of `theirs`, by room, where both are numbers: mean with its
/// interval.
template <class Of>
Interval more_than(const Runs& theirs, const Runs& ours, const Of& of) {
  return bootstrap_mean(less(each(ours, of), each(theirs, of)));
}

/// By which factor of(run) of `ours` is that of `theirs`, by room, where both are positive: geometric mean with
/// its interval.
template <class Of>
Interval times(const Runs& theirs, const Runs& ours, const Of& of) {
  const auto log_of = [&](const Run& run) { return std::log(std::invoke(of, run)); };
  const Interval log = more_than(theirs, ours, log_of);
  return {std::exp(log.value), std::exp(log.low), std::exp(log.high)};
}

/// Lost at the end, or with a position error above 0.5 m (rms): OutcomeMeasures::diverged.
bool diverged(const Run& run);
int diverged_of(const Runs& runs);
int kept_of(const Runs& runs);  ///< that did not diverge
/// Whether nine of ten runs or more did not.
Answer stays_localized(const Runs& runs);
/// Their share.
ClaimNumber share_localized(const Runs& runs);

/// At the end, of vehicle, map and what is not mapped yet, nats.
inline double final_entropy(const Run& run) { return run.entropy_extended; }
inline double located(const Run& run) { return static_cast<double>(run.located_t_s.size()); }
/// Entropy of camera, map and what is not mapped at the first decision with 14 located landmarks; not a number
/// where there were never 14. Its dimension is always the same: that of the map alone grows with what is mapped
/// and not located yet.
double entropy_at_the_14th(const Run& run);
/// When 14 landmarks were located, or the end of the run where there were never 14: a lower bound.
double time_until_the_14th(const Run& run);
int runs_without_14(const Runs& runs);
/// Of the errors of position, axis by axis, the share inside 2 sigma.
double share_inside_2_sigma(const Run& run);
/// Of the moves that a run chose the share across the line of sight, up, down, left and right: two thirds of
/// the six ways are. Not a number where it only stayed.
double share_across(const Run& run);
/// Share of the path that was driven backward.
double share_backwards(const Run& run);
/// Landmarks that came back into view after `away_s`, in all.
double returns(const Run& run);

/// Of those that are numbers, with its interval.
Interval median_known(std::vector<double> numbers);

/// `standing: entropy -273 (...) nats, position error 0.052 m, 21 diverged, 86 % seen, 14 located`: what
/// became of one strategy; of the medians no intervals.
std::string in_numbers(const Runs& runs);
std::string in_numbers(const std::vector<Runs>& runs);

}  // namespace incognita::exploring
