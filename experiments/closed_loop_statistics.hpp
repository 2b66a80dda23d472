// Statistics of many closed-loop runs: tracking errors and consistency.
#pragma once

#include <string>
#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "experiments/evidence.hpp"
#include "experiments/seeds.hpp"
#include "incognita/report/experiment.hpp"

namespace incognita::closed_loop {

/// `198 of 200 (96.4 to 99.9 %)`: 95 % by Clopper and Pearson.
std::string share_text(RunCount of_them, RunCount runs);

/// Of samples in any order; share from 0 to 1.
double quantile(std::vector<double> samples, double share);

/// `median 0.137 m, 95 % below 0.27 m`
std::string spread_text(const std::vector<double>& samples, const std::string& unit);

/// Distances of the control point from the reference, at every tick, m.
std::vector<double> distances_m(const Run& run, const Path& path, std::size_t robot = 0);

/// Mean over the ticks of a run of the pose's NEES; 1 is right.
double mean_nees(const Run& run, std::size_t robot = 0);

/// Ticks of a run at which an error is within two sigmas; by x, y and heading.
Eigen::Array3d share_within_two_sigmas(const Run& run, std::size_t robot = 0);

/// |eigenvalues| of F - G L at a tick, the largest first: (5.5)'s vehicle part with the plant's Jacobians at
/// the estimate and under the input.
Eigen::Vector3d moduli(const RobotInstant& at, const Eigen::Matrix2d& L);

/// The claim of Examples 5.1 and 5.2 that the estimate is consistent enough for control: `within` is the
/// share of ticks with an error within two sigmas, by x, y and heading.
Claim consistent_enough(const std::string& id, const std::string& place, const std::vector<double>& nees,
                        const std::vector<Eigen::Array3d>& within);

/// One result for each run of seeds 1, 2, ...; `what` is reported as progress.
template <class Of>
auto over_seeds(const ExperimentSettings& settings, const std::string& what, const Setup& setup,
                const Of& of) {
  if (settings.report) settings.report(what + ": " + std::to_string(settings.seeds) + " runs");
  return incognita::over_seeds(settings.seeds, [&](std::uint64_t seed) { return of(drive(setup, seed)); });
}

}  // namespace incognita::closed_loop
