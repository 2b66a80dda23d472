// The monobot of thesis Examples 3.1 to 3.10: a robot on a line that nobody steers, and landmarks that it
// sees all the time.
//
// Fixed before anything was run, the same for all examples (the thesis does not print its noises): the robot
// starts at -1 m, all landmarks are at 1 m, 100 steps; process noise 0.1 m a step, measurement noise 0.2 m a
// look, both known to the filter; the robot's place is known at first, the landmarks' to 1 m, as (3.9) has
// it, and the first estimates err by what that says. One step: the robot moves, the filter predicts,
// correlations are dropped if they are to be (3.26), the robot looks, the filter updates.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/report/ledger.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::monobot {

inline constexpr double robot_start_m = -1, landmark_m = 1;

enum class Decorrelated { nothing, everything, map };

struct Setup {
  int landmarks = 1;
  bool anchored = false;  ///< a known landmark at the origin, (3.12)
  Decorrelated decorrelated = Decorrelated::nothing;
  int steps = 100;
  double sigma_v_m = 0.1;  ///< process noise of a step
  double sigma_w_m = 0.2;  ///< noise of a look
  double robot_var_m2 = 0;
  std::optional<double> landmark_var_m2 = 1;  ///< nothing: born from a first look, (2.20)-(2.26)
  // what is wrong and the filter does not know
  double shift_m = 0;                    ///< of all first estimates alike
  double first_measurement_error_m = 0;  ///< added to the first look at the first landmark
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

/// What the filter does whatever it sees. Index: step, from 0, which has no prior and no gain.
struct Course {
  std::vector<Eigen::MatrixXd> prior;      ///< covariance before the update, inflated if it was
  std::vector<Eigen::MatrixXd> inflation;  ///< the dP of (3.26); empty matrices without decorrelation
  std::vector<Eigen::MatrixXd> gain;
  std::vector<Eigen::MatrixXd> posterior;
};
Course course(const Setup& setup);

/// Covariances after each update of the errors that a filter with those gains really makes. They are the
/// posterior ones exactly when nothing is inflated.
std::vector<Eigen::MatrixXd> actual_covariances(const Setup& setup, const Course& course);

/// One run. Columns are steps from 0, rows the robot and the landmarks; m.
struct Run {
  Eigen::MatrixXd truth, estimate, variance;
  Eigen::MatrixXd measurement;  ///< what was seen, rows as in (3.12); column 0 is empty
  Eigen::VectorXd nees;  ///< of all states together; 1 is right. NaN at 0, where the robot is known exactly
  Eigen::MatrixXd error() const { return truth - estimate; }  ///< (3.1)
};
/// The same seed gives the same noises of robot and landmarks whatever the setup.
Run simulate(const Setup& setup, int seed);
/// Seeds 1 to `count`.
std::vector<Run> simulate_all(const Setup& setup, int count);

/// Errors of one state (0: the robot) at one step, over runs.
std::vector<double> errors(const std::vector<Run>& runs, int state, int step);

/// The claim that the filter's bounds are right, for 1 and 2 landmarks: mean NEES after the last step in the
/// chi-square band about 1.
Claim consistent(const std::string& id, const std::string& place, Setup setup, int seeds);

/// The claim that decorrelation makes the filter suboptimal, and its covariances too large rather than too
/// small.
Claim inflated(const std::string& id, const Setup& setup, int seeds);

/// In the steady state, without an anchor and decorrelation: prior variance of what n landmarks together say
/// of the robot's relative position, m^2. Positive root of p^2 = v^2 (p + w^2/n).
double relative_variance(double sigma_v_m, double sigma_w_m, int landmarks = 1);

/// Where the covariance before an update settles then, for equal landmarks and first estimates that are
/// independent: the first estimates, corrected by one exact look at the landmarks' differences and one of
/// variance p at their mean, and p more for the robot.
Eigen::MatrixXd settled_prior(const Setup& setup);

/// Figures 3.4, 3.8, 3.12, 3.15, 3.18: states, the robot's error and the landmark's within 2 sigma, gains;
/// with one landmark (left) and with two. Seed 1.
Plot four_rows(const std::string& id, const std::string& title, Setup setup);

}  // namespace incognita::monobot
