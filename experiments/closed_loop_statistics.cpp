#include "experiments/closed_loop_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
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

std::string share_text(RunCount of_them, RunCount runs) {
  using boost::math::ibeta_inv;
  const double k = of_them.value, n = runs.value, tail = 0.025;
  const double low = k > 0 ? ibeta_inv(k, n - k + 1, tail) : 0;
  const double high = k < n ? ibeta_inv(k + 1, n - k, 1 - tail) : 1;
  return fmt::format("{} of {} ({:.1f} to {:.1f} %)", of_them.value, runs.value, 100 * low, 100 * high);
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

double arrived_s(const Run& run, const Path& path, std::size_t robot) {
  const std::vector<double> distances = distances_m(run, path, {}, robot);
  std::size_t k = distances.size();
  while (k > 0 && distances[k - 1] < near_m) --k;
  return k > 0 ? run.instants[k - 1].t_s + period_s : 0;
}

Claim arrive_by(double by_s, const std::vector<double>& arrived_s, const std::string& id,
                const std::string& place, const std::string& statement, const std::string& printed,
                const std::string& afterwards) {
  const auto there = std::ranges::count_if(arrived_s, [&](double t) { return t < by_s; });
  return assessed(id, place, statement,
                  {.printed = printed,
                   .measured = {"{}, from {:.1f} s on (median). {}", share_text(there, arrived_s.size()),
                                quantile(arrived_s, 0.5), afterwards},
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
      "The estimate stays usable for control: mean NEES of the pose, over its 3 degrees of freedom, below "
      "1.2",
      {.measured =
           {"NEES {}; error within two sigmas at {:.1f}, {:.1f}, {:.1f} % of the ticks (x, y, heading)",
            text(nees), percent[0], percent[1], percent[2]},
       .seeds = runs.size()},
      is_below(nees, 1.2));
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
