// Exploration strategies compared over many seeds, for Sections 6.3 and 6.4.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/compared_numbers.hpp"
#include "experiments/curves.hpp"
#include "experiments/evidence.hpp"
#include "experiments/exploring_run.hpp"
#include "experiments/seeds.hpp"
#include "incognita/report/experiment.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::exploring {

/// A choice of translations and gaze.
struct Strategy {
  std::string name;
  Sets sets;
};

/// Runs of one strategy, by seed.
using Runs = std::vector<Run>;

/// The first room that was not used to choose settings.
inline constexpr std::uint64_t fresh_rooms = 101;

/// Runs of a scenario by that strategy, settings.seeds of them from `first` on. Frames that choose nothing
/// score nothing, unless the strategy says so.
Runs runs_of(const std::string& scenario, const Strategy& strategy, const ExperimentSettings& settings,
             std::uint64_t first = 1);

/// The same by several strategies, one after the other.
std::vector<Runs> runs_of_all(const std::string& scenario, const std::vector<Strategy>& strategies,
                              const ExperimentSettings& settings, std::uint64_t first = 1);

/// What of(run) of `ours` is more than that of `theirs`, by seed, where both are numbers: mean with its 99.9 %
/// interval.
template <class Of>
Interval more_than(const Runs& theirs, const Runs& ours, const Of& of) {
  return bootstrap_mean(less(each(ours, of), each(theirs, of)), assessed_at);
}

/// Settings with half the seeds.
ExperimentSettings half_of(ExperimentSettings settings);

/// Of those that are numbers; none: not a number.
double median_of_known(std::vector<double> numbers);

/// At the end, of vehicle, map and what is not mapped yet, nats.
inline double final_entropy(const Run& run) { return run.entropy_extended; }

/// What became of one strategy, in words.
std::string in_numbers(const std::string& name, const Runs& runs);

/// Of the moves that a run chose the share across the line of sight, up, down, left and right: two thirds of
/// the six ways are. Not a number where it only stayed.
double share_across(const Run& run);

/// Lost at the end, or with a position error above 0.5 m (rms): OutcomeMeasures::diverged.
bool diverged(const Run& run);

/// The claim that a vehicle that starts there drives more than half of its path backward. `variant` ends the
/// statement.
Claim backs_away(const std::string& id, const std::string& place, const std::string& printed,
                 const std::string& start, const Runs& runs, const std::string& why = "",
                 const std::string& variant = "");

/// The claim that `ours` leave less entropy than `theirs`, by paired differences, in all rooms and in those
/// in which neither diverged; `what` names theirs. The measured text adds how many of either diverged, their
/// position errors, and how many pairs had no entropy to compare.
Claim beats(const std::string& id, const std::string& place, const std::string& statement,
            const std::string& what, const Runs& ours, const Runs& theirs, const std::string& why = "");

/// Entropy of the camera, the map, and all; points where landmarks were located: of Figures 6.4, 6.7 and 6.9.
Panel entropies(const std::string& title, const Run& run);
/// The path with the final map, from above.
Panel from_above(const std::string& title, const Run& run);
/// The chosen actions over time.
Panel choices(const std::string& title, const Run& run);
/// A number of every instant.
template <class F>
Curve over_time(const std::string& label, const Run& run, Color color, const F& f,
                Style style = Style::line) {
  return curve_of(label, style, color, run.instants, &Instant::t_s, f);
}

/// Paths, final maps and entropies of the first seed; a column for each strategy: Figures 6.4 and 6.9.
Plot map_figure(const std::string& id, const std::string& title, const std::vector<Strategy>& strategies,
                const std::vector<Runs>& runs);
/// Errors of position and orientation with their bounds, likewise: Figures 6.5 and 6.10.
Plot error_figure(const std::string& id, const std::string& title, const std::vector<Strategy>& strategies,
                  const std::vector<Runs>& runs);

}  // namespace incognita::exploring
