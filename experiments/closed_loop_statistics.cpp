#include "experiments/closed_loop_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/control/lqg_regulator.hpp"

namespace incognita::closed_loop {

Runs runs_of(const ExperimentSettings& settings, const std::string& what, const Setup& setup) {
  if (settings.report) settings.report(what + ": " + std::to_string(settings.seeds) + " runs");
  return over_seeds(settings.seeds, [&](std::uint64_t seed) { return drive(setup, seed); });
}

ExperimentSettings few(ExperimentSettings settings) {
  settings.seeds = std::min(settings.seeds, enough_runs);
  return settings;
}

ClaimNumber share_number(std::string what, RunCount of_them, RunCount runs) {
  const Interval share =
      share_of(static_cast<std::size_t>(of_them.value), static_cast<std::size_t>(runs.value));
  return {std::move(what), {100 * share.value, 100 * share.low, 100 * share.high}, "%"};
}

std::string share_text(RunCount of_them, RunCount runs) {
  const Interval percent = share_number("", of_them, runs).value;
  return fmt::format("{} of {} ({:.1f} to {:.1f} %)", of_them.value, runs.value, percent.low, percent.high);
}

double quantile(std::vector<double> samples, double share) {
  std::ranges::sort(samples);
  const double at = share * static_cast<double>(samples.size() - 1);
  const auto before = static_cast<std::size_t>(at), after = std::min(before + 1, samples.size() - 1);
  return samples[before] + (at - static_cast<double>(before)) * (samples[after] - samples[before]);
}

std::string spread_text(const std::vector<double>& samples, const std::string& unit) {
  return fmt::format("median {:.3g} {}, 95 % below {:.3g} {}", quantile(samples, 0.5), unit,
                     quantile(samples, 0.95), unit);
}

std::vector<double> distances_m(const Run& run, const Path& path, const Span& span, std::size_t robot) {
  const auto distance = [&](const Instant& i) {
    return (i.robots[robot].truth.head<2>() - at(path, i.t_s).position.head<2>()).norm();
  };
  return over_ticks(run, distance, span);
}

double rms_distance_m(const Run& run, const Path& path, const Span& span) {
  return rms_of(distances_m(run, path, span)).value;
}

double rms_estimated_distance_m(const Run& run, const Path& path, const Span& span) {
  const auto distance = [&](const Instant& i) {
    return (i.robots[0].mean.head<2>() - at(path, i.t_s).position.head<2>()).norm();
  };
  return rms_of(over_ticks(run, distance, span)).value;
}

double rms_error_m(const Run& run, const Span& span) {
  const auto error = [](const Instant& i) { return i.robots[0].error().head<2>().norm(); };
  return rms_of(over_ticks(run, error, span)).value;
}

double arrived_s(const Run& run, const Path& path, std::size_t robot) {
  const std::vector<double> distances = distances_m(run, path, {}, robot);
  std::size_t k = distances.size();
  while (k > 0 && distances[k - 1] < near_m) --k;
  return k > 0 ? run.instants[k - 1].t_s + period_s : 0;
}

Claim arrive_by(double by_s, const std::vector<double>& arrived_s, const std::string& id,
                const std::string& place, const std::string& statement, const std::string& afterwards) {
  const auto there = std::ranges::count_if(arrived_s, [&](double t) { return t < by_s; });
  return assessed(id, place, statement,
                  {.rule = Rule::frequency,
                   .measured = {"{}, from {:.1f} s on (median). {}", share_text(there, arrived_s.size()),
                                quantile(arrived_s, 0.5), afterwards},
                   .number = share_number("runs that arrive and stay", there, arrived_s.size()),
                   .seeds = arrived_s.size()},
                  happens_in(0.95, there, arrived_s.size()));
}

Tracking tracking(const Setup& setup, const Run& run, double from_s) {
  std::vector<double> off, estimated;
  for (std::size_t robot = 0; robot < setup.robots.size(); ++robot)
    for (const Instant& i : run.instants) {
      if (i.t_s < from_s) continue;
      const Eigen::Vector2d wanted = at(setup.robots[robot].steering.path, i.t_s).position.head<2>();
      off.push_back((i.robots[robot].truth.head<2>() - wanted).norm());
      estimated.push_back((i.robots[robot].mean.head<2>() - wanted).norm());
    }
  return {rms_of(off).value, std::ranges::max(off), rms_of(estimated).value};
}

std::string text(const std::vector<Tracking>& all, const std::string& what, const std::string& whose) {
  return fmt::format("{}: {}; by {} own estimate {}. The largest of all {:.2f} m", what,
                     spread_text(each(all, &Tracking::rms_m), "m"), whose,
                     spread_text(each(all, &Tracking::estimated_rms_m), "m"),
                     quantile(each(all, &Tracking::largest_m), 1));
}

double mean_nees(const Run& run, std::size_t robot) {
  return mean_of(over_ticks(run, [&](const Instant& i) { return i.robots[robot].nees(); })).value;
}

Claim consistent_enough(const std::string& id, const std::string& place, const Runs& runs) {
  Eigen::Array3d percent = Eigen::Array3d::Zero();
  for (const Run& run : runs) {
    Eigen::Array3d within = Eigen::Array3d::Zero();
    for (const Instant& i : run.instants) {
      const RobotInstant& r = i.robots[0];
      within += (r.error().array().abs() <= 2 * r.covariance.diagonal().array().sqrt()).cast<double>();
    }
    within /= static_cast<double>(run.instants.size());
    percent += 100 * within / static_cast<double>(runs.size());
  }
  const Interval nees = bootstrap_mean(each(runs, [](const Run& run) { return mean_nees(run); }));
  return assessed(
      id, place,
      "The estimate that steers is consistent: mean NEES of the pose, over its 3 degrees of freedom, within "
      "0.2 of 1",
      {.rule = Rule::equality,
       .measured =
           {"NEES {}; error within two sigmas at {:.1f}, {:.1f}, {:.1f} % of the ticks (x, y, heading)",
            text(nees), percent[0], percent[1], percent[2]},
       .number = ClaimNumber{"NEES of the pose", nees},
       .seeds = runs.size()},
      is_consistent(nees));
}

Eigen::Vector3d moduli(const planar::Pose<double>& pose, const Eigen::Vector2d& input,
                       const Eigen::Matrix2d& L) {
  const Eigen::Matrix3d A = planar_closed_loop(body, pose, input, period_s, L);
  Eigen::Vector3d sizes = stability_of(A).eigenvalues.cwiseAbs();
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

void EigenvalueCount::take(double eigenvalue, double speed_m_s, bool is_there) {
  const bool above = eigenvalue > limit;
  (is_there ? there : away) += 1;
  (is_there ? there_above : away_above) += above;
  ahead_above += above && speed_m_s > 0;
  back_below += !above && speed_m_s < backward_m_s;
  largest = std::max(largest, eigenvalue);
}

}  // namespace incognita::closed_loop
