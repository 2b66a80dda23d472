#include "experiments/closed_loop_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <functional>

#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/control/lqg_regulator.hpp"

namespace incognita::closed_loop {

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

std::vector<double> distances_m(const Run& run, const Path& path, std::size_t robot) {
  std::vector<double> distances;
  for (const Instant& i : run.instants)
    distances.push_back((i.robots[robot].truth.head<2>() - at(path, i.t_s).position.head<2>()).norm());
  return distances;
}

double mean_nees(const Run& run, std::size_t robot) {
  double sum = 0;
  for (const Instant& i : run.instants) sum += i.robots[robot].nees();
  return sum / static_cast<double>(run.instants.size());
}

Eigen::Array3d share_within_two_sigmas(const Run& run, std::size_t robot) {
  Eigen::Array3d within = Eigen::Array3d::Zero();
  for (const Instant& i : run.instants) {
    const RobotInstant& r = i.robots[robot];
    within += (r.error().array().abs() <= 2 * r.covariance.diagonal().array().sqrt()).cast<double>();
  }
  return within / static_cast<double>(run.instants.size());
}

Claim consistent_enough(const std::string& id, const std::string& place, const std::vector<double>& nees,
                        const std::vector<Eigen::Array3d>& within) {
  Eigen::Array3d share = Eigen::Array3d::Zero();
  for (const Eigen::Array3d& w : within) share += 100 * w / static_cast<double>(within.size());
  return assessed(
      id, place,
      "The estimate stays usable for control: mean NEES of the pose, over its 3 degrees of freedom, below "
      "1.2",
      {.measured = fmt::format(
           "NEES {}; error within two sigmas at {:.1f}, {:.1f}, {:.1f} % of the ticks (x, y, heading)",
           text(bootstrap_mean(nees)), share[0], share[1], share[2]),
       .seeds = nees.size()},
      is_below(bootstrap_mean(nees), 1.2));
}

Eigen::Vector3d moduli(const RobotInstant& at, const Eigen::Matrix2d& L) {
  const Eigen::Matrix3d A = planar_closed_loop(body, at.mean, at.input, period_s, L);
  Eigen::Vector3d sizes = stability_of(A).eigenvalues.cwiseAbs();
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

}  // namespace incognita::closed_loop
