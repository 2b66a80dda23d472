#include "incognita/app/commands/compare_trajectories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "incognita/app/console/print_message.hpp"
#include "incognita/record/files/tum.hpp"

namespace incognita {
namespace {

constexpr std::size_t min_matches = 3;  // fewer points fit any trajectory

std::string span_of(const Trajectory& trajectory) {
  const auto [first, last] = std::minmax_element(trajectory.begin(), trajectory.end(),
                                                 [](const auto& a, const auto& b) { return a.t < b.t; });
  return fmt::format("{} to {} s", first->t, last->t);
}

/// Prints the reason if NEES was requested but is unavailable.
std::optional<MeanNees> nees_of(const std::string& covariance_file, const MatchedTrajectories& matched) {
  if (covariance_file.empty() || matched.estimate.empty()) return std::nullopt;
  const auto nees = mean_pose_nees(matched, read_covariances(covariance_file));
  if (!nees)
    print_message("evaluate: no NEES: {} has no usable covariance at the matched times\n", covariance_file);
  return nees;
}

void append(MatchedTrajectories& all, const MatchedTrajectories& more) {
  all.estimate.insert(all.estimate.end(), more.estimate.begin(), more.estimate.end());
  all.truth.insert(all.truth.end(), more.truth.begin(), more.truth.end());
}

/// Mean weighted by the number of poses.
std::optional<MeanNees> mean_of(const std::vector<TrajectoryErrors>& vehicles) {
  MeanNees all;
  for (const TrajectoryErrors& v : vehicles) {
    if (!v.nees) continue;
    all.value += v.nees->value * static_cast<double>(v.nees->count);
    all.count += v.nees->count;
  }
  if (all.count == 0) return std::nullopt;
  all.value /= static_cast<double>(all.count);
  return all;
}

bool is_finite(const TrajectoryComparison& comparison) {
  const auto finite = [](const ErrorStatistics& s) { return s.count == 0 || std::isfinite(s.rmse); };
  return std::isfinite(comparison.alignment.scale) && finite(comparison.ate_m) &&
         std::all_of(comparison.vehicles.begin(), comparison.vehicles.end(),
                     [&](const TrajectoryErrors& v) { return finite(v.rpe.translation_m); });
}

/// The trajectories of all vehicles before alignment.
struct Loaded {
  std::vector<MatchedTrajectories> matched;
  std::string spans;  ///< of the first vehicle, for messages
};

Loaded load(const std::vector<TrajectoryFiles>& vehicles, double max_dt_s, TrajectoryComparison& comparison) {
  Loaded loaded;
  for (const TrajectoryFiles& files : vehicles) {
    const Trajectory estimate = read_trajectory(files.estimate);
    // A vehicle of a team whose truth was never known has no truth file.
    const Trajectory truth = files.truth.empty() ? Trajectory{} : read_trajectory(files.truth);
    loaded.matched.push_back(match(estimate, truth, max_dt_s));
    const std::size_t matched = loaded.matched.back().estimate.size();
    comparison.vehicles.push_back({matched, estimate.size(), truth.size(), {}, {}, {}});
    comparison.matched += matched;
    comparison.estimate_poses += estimate.size();
    comparison.truth_poses += truth.size();
    if (loaded.spans.empty() && !truth.empty())
      loaded.spans =
          fmt::format("The estimate spans {}, the truth {}; see --max-dt", span_of(estimate), span_of(truth));
  }
  return loaded;
}

void put_errors(const Loaded& loaded, const std::vector<TrajectoryFiles>& vehicles,
                const ComparisonOptions& options, TrajectoryComparison& comparison) {
  const bool fitted = options.alignment != AlignmentKind::none;
  if (fitted && !vehicles.front().covariance.empty())
    print_message(
        "evaluate: no NEES: it needs --align none, since an alignment removes errors that the covariance includes\n");
  MatchedTrajectories all;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    MatchedTrajectories matched = loaded.matched[i];
    TrajectoryErrors& errors = comparison.vehicles[i];
    if (!fitted) errors.nees = nees_of(vehicles[i].covariance, matched);
    matched.estimate = aligned(matched.estimate, comparison.alignment);
    errors.ate_m = absolute_trajectory_error(matched);
    errors.rpe = relative_pose_error(matched, {options.rpe_delta_s, 0});
    append(all, matched);
  }
  comparison.ate_m = absolute_trajectory_error(all);
  comparison.nees = mean_of(comparison.vehicles);
}

}  // namespace

std::optional<TrajectoryComparison> compare_trajectories(const std::vector<TrajectoryFiles>& vehicles,
                                                         const ComparisonOptions& options) {
  TrajectoryComparison comparison;
  const Loaded loaded = load(vehicles, options.max_dt_s, comparison);
  if (comparison.matched < min_matches) {
    print_message(
        "evaluate: {} of {} estimated poses have a true one within {} s, at least {} are needed. {}\n",
        comparison.matched, comparison.estimate_poses, options.max_dt_s, min_matches, loaded.spans);
    return std::nullopt;
  }
  MatchedTrajectories all;
  for (const MatchedTrajectories& matched : loaded.matched) append(all, matched);
  const auto alignment = align(all, options.alignment);
  if (!alignment) {
    print_message(
        "evaluate: one of the trajectories does not move, so that the scale is undefined; use --align se3\n");
    return std::nullopt;
  }
  comparison.alignment = *alignment;
  put_errors(loaded, vehicles, options, comparison);
  if (is_finite(comparison)) return comparison;
  print_message("evaluate: the positions are too large to be compared; are they in meters?\n");
  return std::nullopt;
}

}  // namespace incognita
