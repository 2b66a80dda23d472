// Statistics of many closed-loop runs: tracking errors, consistency, eigenvalues, and the claims about them.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "experiments/closed_loop_run.hpp"
#include "experiments/evidence.hpp"
#include "experiments/seeds.hpp"
#include "incognita/report/experiment.hpp"

namespace incognita::closed_loop {

using Runs = std::vector<Run>;

/// Runs of seeds 1, 2, ...; `what` is reported as progress.
Runs runs_of(const ExperimentSettings& settings, const std::string& what, const Setup& setup);

/// The same with no more seeds than a claim takes at the least, for what is expensive.
ExperimentSettings few(ExperimentSettings settings);

/// `198 of 200 (96.4 to 99.7 %)`: 95 % by Wilson, as happens_in() has it.
std::string share_text(RunCount of_them, RunCount runs);
/// The same as the number of a claim, in percent.
ClaimNumber share_number(std::string what, RunCount of_them, RunCount runs);

/// Of samples in any order; share from 0 to 1.
double quantile(std::vector<double> samples, double share);

/// `median 0.137 m, 95 % below 0.27 m`
std::string spread_text(const std::vector<double>& samples, const std::string& unit);

/// A part of a run.
struct Span {
  double from_s = 0, until_s = std::numeric_limits<double>::infinity();
};

/// of(instant) at the ticks of that part of a run.
template <class Of>
std::vector<double> over_ticks(const Run& run, const Of& of, const Span& span = {}) {
  std::vector<double> numbers;
  for (const Instant& i : run.instants)
    if (i.t_s >= span.from_s && i.t_s < span.until_s) numbers.push_back(std::invoke(of, i));
  return numbers;
}

/// Distances of the control point from the reference, m.
std::vector<double> distances_m(const Run& run, const Path& path, const Span& span = {},
                                std::size_t robot = 0);

/// Root mean squares over that part of a run, m: distance from the reference, the same by the estimate, and the
/// error of the estimated position.
double rms_distance_m(const Run& run, const Path& path, const Span& span = {});
double rms_estimated_distance_m(const Run& run, const Path& path, const Span& span = {});
double rms_error_m(const Run& run, const Span& span = {});

inline constexpr double near_m = 0.5;

/// From when on the control point stays within near_m of the reference.
double arrived_s(const Run& run, const Path& path, std::size_t robot = 0);

/// The claim that 95 % of the runs arrive before `by_s`; `afterwards` ends what was measured.
Claim arrive_by(double by_s, const std::vector<double>& arrived_s, const std::string& id,
                const std::string& place, const std::string& statement, const std::string& afterwards);

/// How all robots of a run follow their paths, from some time on.
struct Tracking {
  double rms_m = 0, largest_m = 0;
  double estimated_rms_m = 0;  ///< by the robots' own estimates
};
Tracking tracking(const Setup& setup, const Run& run, double from_s);

/// `rms: ...; by its own estimate ... The largest of all ...`
std::string text(const std::vector<Tracking>& all, const std::string& what, const std::string& whose);

/// Mean over the ticks of a run of the pose's NEES; 1 is right.
double mean_nees(const Run& run, std::size_t robot = 0);

/// The claim of Examples 5.1 and 5.2 that the estimate that steers is consistent.
Claim consistent_enough(const std::string& id, const std::string& place, const Runs& runs);

/// |eigenvalues| of F - G L the largest first: (5.5)'s vehicle part with the plant's Jacobians at a pose and
/// under an input; at a tick, those of the estimate.
Eigen::Vector3d moduli(const planar::Pose<double>& pose, const Eigen::Vector2d& input,
                       const Eigen::Matrix2d& L);
inline Eigen::Vector3d moduli(const RobotInstant& at, const Eigen::Matrix2d& L) {
  return moduli(at.mean, at.input, L);
}

/// Ticks at which an eigenvalue is above 1, by where the vehicle is and by which way it moves.
struct EigenvalueCount {
  double limit = 1, backward_m_s = 0;  ///< above 1, and backward, but for rounding
  int away = 0, away_above = 0, there = 0, there_above = 0;
  int ahead_above = 0, back_below = 0;  ///< above 1 while it moves forward, below while backward
  double largest = 0;

  void take(double eigenvalue, double speed_m_s, bool is_there);
};

}  // namespace incognita::closed_loop
