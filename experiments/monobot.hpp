// The monobot of thesis Examples 3.1 to 3.10: a robot on a line without control, and landmarks that it
// measures at every step.
//
// Fixed before anything was run, the same for all examples (the thesis does not print its noises): the robot
// starts at -1 m, all landmarks are at 1 m, 100 steps; process noise 0.1 m a step, measurement noise 0.2 m,
// both known to the filter; the robot's position is known at first, the landmarks' to 1 m, as in (3.9), and
// the first estimates are drawn with these sigmas. One step: the robot moves, the filter predicts, the
// covariance is decorrelated if that is set (3.26), the robot measures, the filter updates.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/report/ledger.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::monobot {

inline constexpr double robot_start_m = -1, landmark_m = 1;

enum class Decorrelated { nothing, everything, map };
/// `map` or `everything`
const char* name(Decorrelated what);

struct Setup {
  int landmarks = 1;
  bool anchored = false;  ///< a known landmark at the origin, (3.12)
  Decorrelated decorrelated = Decorrelated::nothing;
  int steps = 100;
  double sigma_v_m = 0.1;  ///< process noise of a step
  double sigma_w_m = 0.2;  ///< noise of a measurement
  double robot_var_m2 = 0;
  std::optional<double> landmark_var_m2 = 1;  ///< none: initialized from the first measurement, (2.20)-(2.26)
  // errors that are unknown to the filter
  double shift_m = 0;                    ///< of all first estimates alike
  double first_measurement_error_m = 0;  ///< added to the first measurement of the first landmark
};

int states(const Setup& setup);  ///< the robot's and the landmarks'

/// (3.7), or (3.12) with the anchor's row first; for any number of landmarks.
LinearSystem system(const Setup& setup);

/// The same with more process noise of covariance dP on the states: G' = [G I], (3.27).
LinearSystem with_pseudo_noise(const LinearSystem& system, const Eigen::MatrixXd& dP);

/// Rank of [G Q^1/2, dP^1/2]: how many states' combinations process noise and dP reach together. F is I here,
/// so that this is the rank of controllability too.
Rank excited(const Setup& setup, const Eigen::MatrixXd& dP);

/// Covariance of the first estimates: robot, landmarks.
Eigen::MatrixXd first_covariance(const Setup& setup);

/// Covariances and gains of the filter, which do not depend on the measurements. Index: step, from 0, which
/// has no prior and no gain.
struct Course {
  std::vector<Eigen::MatrixXd> prior;      ///< covariance before the update, inflated if it was
  std::vector<Eigen::MatrixXd> inflation;  ///< the dP of (3.26); empty matrices without decorrelation
  std::vector<Eigen::MatrixXd> gain;
  std::vector<Eigen::MatrixXd> posterior;
};
Course course(const Setup& setup);

/// Actual error covariances, after each update, of a filter with those gains. They are the
/// posterior ones exactly when nothing is inflated.
std::vector<Eigen::MatrixXd> actual_covariances(const Setup& setup, const Course& course);

/// One run. Columns are steps from 0, rows the robot and the landmarks; m.
struct Run {
  Eigen::MatrixXd truth, estimate, variance;
  Eigen::MatrixXd measurement;  ///< the measurements, rows as in (3.12); column 0 is empty
  Eigen::VectorXd nees;  ///< of all states together; 1 is right. NaN at 0, where the robot is known exactly
  Eigen::MatrixXd error() const { return truth - estimate; }  ///< (3.1)
};
/// The same seed gives the same noises of robot and landmarks whatever the setup.
Run simulate(const Setup& setup, std::uint64_t seed);
/// Seeds 1 to `count`.
std::vector<Run> simulate_all(const Setup& setup, int count);

/// Whether every variance of `a` is smaller than that of `b`, at every step from the first update on.
bool smaller_variances(const std::vector<Eigen::MatrixXd>& a, const std::vector<Eigen::MatrixXd>& b);

/// Errors of one state (0: the robot) at one step, over runs.
std::vector<double> errors(const std::vector<Run>& runs, int state, int step);

/// How much less the squares of `fewer` are than those of `more`, run by run.
std::vector<double> squares_less(const std::vector<double>& fewer, const std::vector<double>& more);

/// The claim that the filter's bounds are right, for 1 and 2 landmarks: mean NEES after the last step near 1.
Claim consistent(const std::string& id, const std::string& place, Setup setup, int seeds);

/// The claim that decorrelation makes the filter suboptimal, and its covariances too large rather than too
/// small.
Claim inflated(const std::string& id, const Setup& setup, int seeds);

/// In the steady state, without an anchor and decorrelation: prior variance of the robot's position relative
/// to n landmarks together, m^2. Positive root of p^2 = v^2 (p + w^2/n).
double relative_variance(double sigma_v_m, double sigma_w_m, int landmarks = 1);

/// Where the covariance before an update settles then, for equal landmarks and first estimates that are
/// independent: the first estimates, corrected by one exact measurement of the landmarks' differences and one
/// of variance p of their mean, and p more for the robot.
Eigen::MatrixXd settled_prior(const Setup& setup);

/// Figures 3.3 and 3.7: eigenvalues over the noises s_v and s_w, both from 0.1 to 2 m, in two panels. `of(v,
/// w)` has as many numbers as there are labels.
struct EigenvaluePanel {
  std::string title;
  std::vector<std::string> labels;
  std::function<std::vector<double>(double v, double w)> of;
};
Plot eigenvalue_surfaces(const std::string& id, const std::string& title,
                         const std::vector<EigenvaluePanel>& panels);

/// Figures 3.4, 3.8, 3.12, 3.15, 3.18: states, the robot's error and the landmark's within 2 sigma, gains;
/// with one landmark (left) and with two. Seed 1.
Plot four_rows(const std::string& id, const std::string& title, Setup setup);

}  // namespace incognita::monobot
