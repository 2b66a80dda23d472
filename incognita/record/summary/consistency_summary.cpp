#include "incognita/record/summary/consistency_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

/// Whether the mean NIS of the first fifth of the updates exceeds the band: a wrong model shows from the
/// start, a deteriorating map only later.
bool beyond_from_the_start(const std::vector<double>& nis, const Interval& band) {
  const auto first = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, nis.size() / 5));
  return std::accumulate(nis.begin(), nis.begin() + first, 0.0) / static_cast<double>(first) > band.high;
}

void explain_large_nis(ConsistencyReport& report, bool from_the_start) {
  if (from_the_start) {
    report.symptom = "innovations are larger than their covariance, from the start";
    report.causes = {"sign or axis of a measurement (bearings are positive to the left)",
                     "unit (degrees for radians, mm for m)",
                     "clock (ms for s, odometry and measurements shifted in time)",
                     "measurement noise set too low"};
  } else {
    report.symptom = "innovations become larger than their covariance";
    report.causes = {"motion noise set too low (slip, jerks)", "wrong data association",
                     "measurement noise set too low"};
  }
}

void explain_large_nees(ConsistencyReport& report) {
  report.symptom = "innovations are consistent, but pose errors are larger than their covariance";
  report.causes = {"start pose error larger than its sigma", "truth in another frame or on another clock",
                   "wrong data association or duplicate landmarks",
                   "correlated errors, e.g. a bias, where the filter assumes white noise", "linearization"};
}

void explain_conservative(ConsistencyReport& report) {
  report.symptom = report.pose.nees ? "pose errors are smaller than their covariance"
                                    : "innovations are smaller than their covariance";
  report.causes = {"measurement noise set too high, or raised to cover biases", "motion noise set too high"};
}

void explain_outliers(ConsistencyReport& report) {
  explain_large_nis(report, true);
  report.symptom = fmt::format(
      "{:.0f} % of the measurements are outside their gates (a consistent filter: up to {:.0f} %)",
      100 * *report.outlier_share, 100 * highest_outlier_share);
}

void explain_low_nis(ConsistencyReport& report) {
  report.symptom =
      "innovations are smaller than their covariance: the measurement noise is raised to cover biases, or set too high";
}

bool has_many_outliers(const ConsistencyReport& report) {
  return report.outlier_share && *report.outlier_share > highest_outlier_share;
}

/// NEES decides where the truth is known: a low NIS alone also results from measurement noise that was
/// increased to cover systematic errors. A high NIS always indicates a wrong model.
Consistency verdict_of(const ConsistencyReport& report) {
  const auto overconfident = [](const PoseConsistency& pose) {
    return pose.verdict() == Consistency::overconfident;
  };
  if (overconfident(report.pose) || std::any_of(report.bodies.begin(), report.bodies.end(), overconfident))
    return Consistency::overconfident;
  if (has_many_outliers(report)) return Consistency::overconfident;
  const Consistency by_nis = report.nis ? report.nis->verdict() : Consistency::unknown;
  return by_nis == Consistency::overconfident || !report.pose.nees ? by_nis : report.pose.verdict();
}

}  // namespace

void ConsistencySummary::Sum::add(double square, int dof) {
  per_dof += square / dof;
  dof_in_all += dof;
  ++count;
}

double ConsistencySummary::Sum::mean() const {
  return count > 0 ? per_dof / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

void ConsistencySummary::add(const Snapshot& snapshot) {
  if (snapshot.nis_dof > 0) {
    nis_.add(snapshot.nis, snapshot.nis_dof);
    nis_per_dof_.push_back(snapshot.nis / snapshot.nis_dof);
  }
  for (const SnapshotMatch& match : snapshot.matches) {
    matches_ += match.outcome == MatchOutcome::matched;
    outliers_ += match.outcome == MatchOutcome::outlier;
  }
  if (compare_) compare(snapshot);
}

void ConsistencySummary::compare(const Snapshot& snapshot) {
  bodies_.resize(std::max(bodies_.size(), snapshot.bodies.size()));
  bool any_truth = false, any_overconfident = false;
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    const SnapshotBody& of = snapshot.bodies[i];
    if (!of.truth || !has_pose(of)) continue;
    Body& body = bodies_[i];
    const PoseError error = pose_error(*of.truth, of.estimate);
    const PoseCovariance& P = of.covariance;
    const bool overconfident =
        of.state == TrackingState::tracking && beyond_three_sigma(error.head<3>(), P.topLeftCorner<3, 3>());
    ++body.frames_with_truth;
    body.overconfident_frames += overconfident;
    any_truth = true;
    any_overconfident |= overconfident;
    const auto square = pose_normalized_square(error, P);
    if (!square) continue;
    body.nees.add(square->sum, square->degrees_of_freedom);
    body.most_dof = std::max(body.most_dof, square->degrees_of_freedom);
    nees_.add(square->sum, square->degrees_of_freedom);
  }
  frames_with_truth_ += any_truth;
  overconfident_frames_ += any_overconfident;
}

ConsistencyReport ConsistencySummary::report() const {
  ConsistencyReport report;
  report.nis = mean_nis_of_run(nis_.mean(), nis_.count, nis_.dof_in_all);
  if (const std::int64_t all = matches_ + outliers_; all >= fewest_samples)
    report.outlier_share = static_cast<double>(outliers_) / static_cast<double>(all);
  int dof = 0;
  for (const Body& body : bodies_) {
    dof += body.most_dof;
    report.bodies.push_back({body.frames_with_truth, body.overconfident_frames,
                             mean_nees_of_run(body.nees.mean(), body.nees.count, body.most_dof)});
  }
  report.pose = {frames_with_truth_, overconfident_frames_, mean_nees_of_run(nees_.mean(), nees_.count, dof)};
  report.verdict = verdict_of(report);
  const Consistency by_nis = report.nis ? report.nis->verdict() : Consistency::unknown;
  if (by_nis == Consistency::overconfident)
    explain_large_nis(report, beyond_from_the_start(nis_per_dof_, report.nis->band));
  else if (has_many_outliers(report))
    explain_outliers(report);
  else if (report.verdict == Consistency::overconfident)
    explain_large_nees(report);
  else if (report.verdict == Consistency::conservative)
    explain_conservative(report);
  else if (by_nis == Consistency::conservative)
    explain_low_nis(report);
  else if (report.verdict == Consistency::unknown)
    report.symptom = fmt::format("fewer than {} updates", fewest_samples);
  return report;
}

}  // namespace incognita
