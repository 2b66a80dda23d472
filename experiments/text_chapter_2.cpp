// Claims in the running text of Chapter 2, and of Appendix A.
//
// Experiment: the monobot of monobot.hpp, from its start and from one with the robot known to 1 m and
// landmarks initialized from measurements; 300 steps unless said. Vehicle of the plane: standing at the
// origin, known to 0.5 m and 10 degrees; a landmark 10 m ahead, 100 measurements of 0.1 m and 1, 3 or 10
// degrees. Initializations: 100000 draws. Joseph form: 2000 covariances and measurement noises. Appendix A.1: 1000
// random systems of two to six states with a known input, against weighted least squares. Holds: sequences
// as claimed (rounding of 1e-12 allowed), closed forms to 1e-9 relative, variances of draws to 3 %, means over
// runs by their intervals.
#include "experiments/boundedness.hpp"
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"
#include "experiments/planar_consistency.hpp"
#include "experiments/text_claims.hpp"
#include "incognita/models/motion/monobot.hpp"

namespace incognita {
namespace {

using namespace monobot;

/// From a known robot, as in Example 3.1, and from one known to 1 m with landmarks initialized from
/// measurements.
std::vector<Setup> starts(int landmarks, int steps = 300) {
  const Setup known{.landmarks = landmarks, .steps = steps};
  Setup initialized = known;
  initialized.robot_var_m2 = 1;
  initialized.landmark_var_m2.reset();
  return {known, initialized};
}

Claim precision_increases() {
  double landmark_rise = 0, robot_rise = 0;
  for (const int n : {1, 2, 5})
    for (const Setup& setup : starts(n)) {
      const auto P = course(setup).posterior;
      for (std::size_t k = 1; k < P.size(); ++k) {
        const VectorXd rise = P[k].diagonal() - P[k - 1].diagonal();
        robot_rise = std::max(robot_rise, rise[0]);
        landmark_rise = std::max(landmark_rise, rise.tail(n).maxCoeff());
      }
    }
  return assessed(
      "text-2.2-precision", "Section 2.2",
      "The precision of vehicle and landmark locations increases monotonically: no variance ever rises from "
      "one update to the next",
      {.rule = Rule::example,
       .measured = {"largest rise with 1, 2, 5 landmarks and two starts: landmarks {}, robot {:.2g} m^2",
                    below(landmark_rise), robot_rise},
       .number = exactly("largest rise of the robot's variance in a step", robot_rise, "m^2"),
       .why = "of the landmarks. The vehicle moves, and its variance rises"},
      std::max(landmark_rise, robot_rise) <= rounding_error, on_condition(landmark_rise <= rounding_error));
}

Claim vehicle_is_bounded() {
  const auto P = course({.steps = 10'000}).posterior;
  const double grown = growth_between(P[5000](0, 0), P[10'000](0, 0));
  const double dead_reckoning = 10'000 * 0.1 * 0.1;
  return assessed(
      "text-2.2-bounded", "Sections 2.1 and 2.2",
      "The vehicle's estimate becomes bounded: its variance grows by less than 5 % in the second half of "
      "10000 steps",
      {.rule = Rule::boundedness,
       .measured =
           {"after 100 and 10000 steps {:.4f} and {:.4f} m^2; from odometry alone {:.0f} m^2 after 10000",
            P[100](0, 0), P[10'000](0, 0), dead_reckoning},
       .number = exactly("variance of the robot after 10000 steps", P[10'000](0, 0), "m^2")},
      is_bounded(grown));
}

double correlation(const MatrixXd& P, int i, int j) { return P(i, j) / std::sqrt(P(i, i) * P(j, j)); }

Claim correlations_grow() {
  double fall = 0;
  Extremes first, last;
  for (const int n : {2, 5})
    for (const Setup& setup : starts(n)) {
      const auto P = course(setup).posterior;
      for (std::size_t k = 1; k < P.size(); ++k)
        fall = std::max(fall, correlation(P[k - 1], 1, 2) - correlation(P[k], 1, 2));
      first.take(correlation(P[1], 1, 2)), last.take(correlation(P[300], 1, 2));
    }
  return assessed(
      "text-2.2-correlations", "Section 2.2 and 2.2.1",
      "Correlations between landmarks increase monotonically as they are observed",
      {.rule = Rule::example,
       .measured =
           {"two and five landmarks from two starts each: {:.2f} to {:.2f} after 1 step, {:.4f} to {:.4f} "
            "after 300; largest fall {}",
            first.least, first.most, last.least, last.most, below(fall)}},
      fall <= rounding_error);
}

Claim lower_bound() {
  double nearest = 1e300;
  for (const double v : {0.0, 0.1, 0.3})
    for (const int n : {1, 2, 5})
      for (const double robot : {0.0, 0.5, 1.0}) {
        const Setup setup{.landmarks = n, .sigma_v_m = v, .robot_var_m2 = robot, .landmark_var_m2 = {}};
        nearest = std::min(nearest, after(setup, 1000).diagonal().tail(n).minCoeff() - robot);
      }
  return assessed(
      "text-3.1-lower-bound", "Sections 2.2 and 3.1, property (3)",
      "No landmark's variance falls below the vehicle's when the first landmark was first seen",
      {.rule = Rule::example,
       .measured =
           {"nearest to it after 1000 steps, 27 combinations of noise, number and start: {:.2g} m^2 above",
            nearest}},
      nearest >= -rounding_error);
}

Claim bound_is_reached() {
  Extremes limits;
  Worst worst;
  for (const double v : {0.05, 0.1, 0.3})
    for (const int n : {1, 5}) {
      const Setup setup{.landmarks = n, .sigma_v_m = v, .robot_var_m2 = 0.25, .landmark_var_m2 = {}};
      // the covariance of robot and landmark is the limit of the landmark's variance, and is there sooner
      const double limit = after(setup, 1000)(0, 1);
      worst.take(std::abs(limit / 0.25 - 1), std::abs(limit / settled_prior(setup)(0, 1) - 1));
      limits.take(limit);
    }
  return assessed(
      "text-3.1-bound-reached", "Sections 2.2 and 3.1, property (3)",
      "In the limit each landmark's variance reaches that bound, which depends on nothing else; to 1e-9",
      {.measured = {"bound 0.25 m^2; with s_v 0.05, 0.1, 0.3 m and 1 or 5 landmarks they settle at {:.4f} to "
                    "{:.4f} m^2. Largest relative difference: {}",
                    limits.least, limits.most, worst.text()},
       .number = exactly("most that a landmark's variance settles above the bound", 100 * worst.printed, "%"),
       .why =
           "it settles (sqrt(s_v^4 + 4 s_v^2 s_w^2/n) - s_v^2)/2 above: process noise, measurement noise and "
           "the number of landmarks count as well"},
      worst.printed <= 1e-9, in_truth(worst.ours <= 1e-9));
}

Claim riccati_depends() {
  double off = 0;
  int cases = 0;
  for (const double robot : {0.0, 0.25, 1.0})
    for (const double v : {0.05, 0.1, 0.3})
      for (const double w : {0.1, 0.2, 0.5})
        for (const int n : {1, 2, 5}) {
          const Setup setup{
              .landmarks = n, .sigma_v_m = v, .sigma_w_m = w, .robot_var_m2 = robot, .landmark_var_m2 = {}};
          const MatrixXd P = after(setup, 400), prior = settled_prior(setup);
          off = std::max(
              {off, std::abs(P(0, 1) / prior(0, 1) - 1), std::abs(P(0, 0) / (prior(0, 0) - v * v) - 1)});
          ++cases;
        }
  return assessed(
      "text-2.18-depends", "below (2.18), Section 3.1",
      "In linear SLAM the Riccati equation still converges, to a solution that is a function of the robot's "
      "first covariance, Q, R and the number of landmarks",
      {.measured = {"covariance of landmarks initialized at the start: P_r + q, robot P_r + 2 q, with q = "
                    "(sqrt(s_v^4 + 4 s_v^2 s_w^2/n) - s_v^2)/2; largest relative difference over {} "
                    "combinations {}. Landmarks with a prior add its information",
                    cases, below(off)}},
      off <= 1e-9);
}

Claim riccati_needs_observability() {
  const Setup setup;
  const LinearSystem s = system(setup);
  const RiccatiLimit limit = iterate_riccati(s, predicted(s, first_covariance(setup)));
  const RiccatiLimit excited = iterate_riccati(with_noisy_landmarks(setup), first_covariance(setup));
  const int rank = rank_of(observability_matrix(s)).rank;
  const double off = relative_difference(settled_prior(setup), limit.P);
  return assessed(
      "text-2.18-only-if", "below (2.18)",
      "The solution of the Riccati equation converges only if (F, H) is completely observable: "
      "the monobot without an anchor must not settle",
      {.rule = Rule::example,
       .measured = {"observability rank {} of 2, and it {}, at the closed form for its first covariance "
                    "(relative difference {}). With noise of 0.05 m a step on the landmark it {}",
                    rank, limit.reason, below(off), excited.settled ? "settles" : "does not settle"},
       .number = exactly("steps until it settles", limit.iterations),
       .why = "it settles where no noise reaches what cannot be observed, as here, at a value that "
              "depends on the first covariance; where noise reaches it, it does not"},
      rank < 2 && !limit.settled, in_truth(rank < 2 && limit.settled && off <= 1e-9 && !excited.settled));
}

/// Variance of a landmark that is initialized by a robot of variance P_rr, by drawing both noises.
Claim initial_covariance() {
  constexpr double robot_sigma = 0.5, measurement_sigma = 0.2;  // m
  constexpr int draws = 100'000;
  RandomStream random(1, "births");
  std::vector<double> squares;
  for (int i = 0; i < draws; ++i) {
    const double robot_error = robot_sigma * random.normal(), noise = measurement_sigma * random.normal();
    const double z = RelativePosition::predict_measurement(0, 2).z[0] + noise;
    squares.push_back(std::pow(RelativePosition::initialize(robot_error, z).landmark[0] - 2, 2));
  }
  const Interval drawn = mean_of(squares);
  const double P = robot_sigma * robot_sigma;
  const RelativePosition::Initialization by;
  const double printed = by.Jv[0] * P * by.Jv[0] + by.Jz[0] * P * by.Jz[0];
  const Setup setup{.sigma_w_m = measurement_sigma, .robot_var_m2 = P, .landmark_var_m2 = {}};
  const double ours = start_of(setup)(1, 1);
  return assessed(
      "text-2.25-birth", "(2.25)",
      "Covariance of a new landmark (robot known to 0.5 m, measurement to 0.2 m), to 3 % of what "
      "drawing them gives",
      {.rule = Rule::equality,
       .printed = "P_ff = J_r P_rr J_r' + J_m P_rr J_m'",
       .measured = {"drawn {}, printed {:.3f} m^2, ours {:.3f} m^2. With range and bearing P_rr is 3x3 "
                    "and J_m 2x2: the printed product does not exist",
                    text(drawn, "m^2"), printed, ours},
       .number = ClaimNumber{"variance of the new landmark, drawn", drawn, "m^2"},
       .why = "J_r P_rr J_r' + J_m R J_m', with the noise of the first measurement",
       .runs = draws},
      agrees(drawn, printed, 0.03 * printed), as_corrected(agrees(drawn, ours, 0.03 * ours)));
}

Claim dependent_errors() {
  const auto landmark_variance = [](double v, int steps) {
    return after({.sigma_v_m = v, .landmark_var_m2 = {}}, steps)(1, 1);
  };
  const double still_100 = landmark_variance(0, 100), still_1000 = landmark_variance(0, 1000),
               moving_100 = landmark_variance(0.1, 100), moving_1000 = landmark_variance(0.1, 1000);
  const bool cancels =
      std::abs(still_100 * 101 / 0.04 - 1) < 1e-9 && std::abs(still_1000 * 1001 / 0.04 - 1) < 1e-9;
  return assessed(
      "text-2.2.3-dependent", "Section 2.2.3",
      "Where errors are independent they cancel out over more and more measurements: variance as one over "
      "their number (to 1e-9). Errors of control accumulate and enter every measurement, and they do not "
      "cancel: the variance after 1000 measurements is that after 100, to 1 %",
      {.rule = Rule::equality,
       .measured = {"landmark of a known robot that stands still: {:.2e} and {:.2e} m^2 after 100 and 1000 "
                    "steps; of one that moves by 0.1 m a step: {:.4f} and {:.4f} m^2",
                    still_100, still_1000, moving_100, moving_1000},
       .number = exactly("landmark's variance after 1000 measurements, robot in motion", moving_1000, "m^2")},
      cancels && std::abs(moving_1000 / moving_100 - 1) < 0.01);
}

/// A gain other than Kalman's, and what it costs: trace of the covariance after the update, over the least.
Claim optimal() {
  RandomStream random(1, "gains");
  double least = 1e300, off = 0;
  for (int i = 0; i < 1000; ++i) {
    const Setup setup{.landmarks = 1 + random.below(4), .anchored = random.below(2) == 1};
    const LinearSystem s = system(setup);
    const MatrixXd P = predicted(s, filtered(s, first_covariance(setup), 1 + random.below(20)));
    const MatrixXd K = kalman_gain(s, P), S = s.H * P * s.H.transpose() + s.R;
    const MatrixXd other =
        K + MatrixXd::NullaryExpr(K.rows(), K.cols(), [&] { return 0.05 * random.normal(); });
    off = std::max(off, (updated(s, P, K) - (P - K * S * K.transpose())).norm() / P.norm());
    least = std::min(least, updated(s, P, other).trace() / updated(s, P, K).trace());
  }
  return assessed(
      "text-2.2.1-optimal", "Section 2.2.1, (2.16), (2.17)",
      "The Kalman filter is the estimator of minimum mean square error: every other gain has a larger trace, "
      "and with its own gain (2.17) is the covariance (to 1e-12)",
      {.rule = Rule::example,
       .measured =
           {"1000 other gains: trace at least {:.6f} times as large; (2.17) against the Joseph form: {}",
            least, below(off)},
       .runs = 1000},
      least > 1 && off <= 1e-12);
}

/// Of a covariance that may have lost its symmetry, over the largest.
double least_eigenvalue_share(const MatrixXd& P) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver((P + P.transpose()) / 2, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] / solver.eigenvalues().cwiseAbs().maxCoeff();
}

/// The covariance after an update, by the Joseph form and by (2.17), with Kalman's gain and with one that is
/// some percent off. Measurements are up to 1e8 times as accurate as the prior.
Claim joseph_form() {
  constexpr int cases = 2000;
  RandomStream random(1, "joseph");
  double least = 1;
  int lost = 0;
  for (int i = 0; i < cases; ++i) {
    const int n = 2 + random.below(5), m = 1 + random.below(n);
    const auto normal = [&] { return random.normal(); };
    const MatrixXd root = MatrixXd::NullaryExpr(n, n, normal), P = root * root.transpose();
    LinearSystem s;
    s.F = s.G = s.Q = MatrixXd::Identity(n, n);
    s.H = MatrixXd::NullaryExpr(m, n, normal);
    s.R = std::pow(10, -random.uniform(0, 16)) * MatrixXd::Identity(m, m);
    const MatrixXd K = kalman_gain(s, P), S = s.H * P * s.H.transpose() + s.R;
    const MatrixXd off =
        K + K.cwiseProduct(MatrixXd::NullaryExpr(n, m, [&] { return 0.1 * random.normal(); }));
    for (const MatrixXd& gain : {K, off})
      least = std::min(least, least_eigenvalue_share(updated(s, P, gain)));
    if (least_eigenvalue_share(P - off * S * off.transpose()) < -rounding_error) ++lost;
  }
  return assessed(
      "text-A.2-joseph", "(A.2.7)",
      "The Joseph form guarantees a positive semi-definite covariance, for any gain and in spite of "
      "rounding: its smallest eigenvalue is above -1e-12 of its largest",
      {.rule = Rule::example,
       .measured = {"{} covariances, measurement noises of 1e-8 to 1 m, gains of Kalman and some 10 % off: "
                    "most negative eigenvalue over the largest: {}; by (2.17) {} of those with the gain "
                    "that is off have a negative one",
                    cases, below(std::min(least, 0.0)), lost},
       .number = exactly(fmt::format("of {} covariances with a negative eigenvalue by (2.17), gain off by "
                                     "a tenth",
                                     cases),
                         lost),
       .runs = cases},
      least >= -rounding_error);
}

/// One step of a linear filter with known input, noise added to the state, as in (A.1.1) and (A.1.2).
struct FilterStep {
  LinearSystem s;  ///< with G = I of the process noise
  MatrixXd G, P;   ///< of the input; covariance before
  VectorXd x, u, z;
};

FilterStep drawn_step(RandomStream& random) {
  const int n = 2 + random.below(5), m = 1 + random.below(n), inputs = 1 + random.below(3);
  const auto any = [&](int rows, int columns) -> MatrixXd {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
  };
  const auto covariance = [&](int size) -> MatrixXd {
    const MatrixXd root = any(size, size);
    return root * root.transpose() + 0.1 * MatrixXd::Identity(size, size);
  };
  FilterStep step;
  step.s.F = any(n, n), step.s.G = MatrixXd::Identity(n, n), step.s.H = any(m, n);
  step.s.Q = covariance(n), step.s.R = covariance(m);
  step.G = any(n, inputs), step.P = covariance(n);
  step.x = any(n, 1), step.u = any(inputs, 1), step.z = any(m, 1);
  return step;
}

/// The state after the step by weighted least squares over the states before and after: without the filter's
/// equations. With the measurement its estimate, without it its covariance.
struct LeastSquares {
  VectorXd estimate;
  MatrixXd covariance;
};

LeastSquares least_squares(const FilterStep& step, bool measured) {
  const auto n = step.x.size();
  const MatrixXd W = step.s.Q.inverse(), V = step.s.R.inverse(), prior = step.P.inverse();
  MatrixXd motion(n, 2 * n), information = MatrixXd::Zero(2 * n, 2 * n);
  motion << -step.s.F, MatrixXd::Identity(n, n);
  VectorXd right = motion.transpose() * W * step.G * step.u;
  information = motion.transpose() * W * motion;
  information.topLeftCorner(n, n) += prior;
  right.head(n) += prior * step.x;
  if (measured) {
    information.bottomRightCorner(n, n) += step.s.H.transpose() * V * step.s.H;
    right.tail(n) += step.s.H.transpose() * V * step.z;
  }
  const MatrixXd covariance = information.inverse();
  return {(covariance * right).tail(n), covariance.bottomRightCorner(n, n)};
}

std::vector<Claim> filter_in_one_step() {
  constexpr int cases = 1000;
  RandomStream random(1, "appendix-a.1");
  double of_steps = 0, of_least_squares = 0, of_prediction = 0;
  for (int i = 0; i < cases; ++i) {
    const FilterStep step = drawn_step(random);
    const auto& [F, none, H, Q, R] = step.s;
    const MatrixXd P = F * step.P * F.transpose() + Q, K = kalman_gain(step.s, P);  // (A.1.7)
    const VectorXd expected = F * step.x + step.G * step.u,                         // (A.1.3)
        updated = expected + K * (step.z - H * expected),                           // (A.1.4), (A.1.5)
        closed = (F - K * H * F) * step.x + (step.G - K * H * step.G) * step.u + K * step.z;
    of_steps = std::max(of_steps, relative_difference(closed, updated));
    of_least_squares =
        std::max(of_least_squares, relative_difference(closed, least_squares(step, true).estimate));
    of_prediction = std::max(of_prediction, relative_difference(P, least_squares(step, false).covariance));
  }
  return {
      assessed(
          "text-A.1-closed-loop", "(A.1.6)",
          "The closed form of a step of the Kalman filter, linear and with known input, is its prediction "
          "followed by its update, and the least squares estimate; to 1e-9 relative",
          {.printed = "(F - KHF) x + (G - KHG) u + K z",
           .measured = {"largest difference in {} random systems: from (A.1.3) to (A.1.5) {}, from least "
                        "squares over both states {}",
                        cases, below(of_steps), below(of_least_squares)},
           .runs = cases},
          of_steps < 1e-9 && of_least_squares < 1e-9),
      assessed(
          "text-A.1-prediction", "(A.1.7)",
          "F P F' + Q is the covariance of the predicted state where the noise is added to the state, as "
          "in (A.1.1); to 1e-9 relative",
          {.printed = "F P F' + Q_k",
           .measured = {"largest difference from least squares over both states in {} random systems: {}",
                        cases, below(of_prediction)},
           .runs = cases},
          of_prediction < 1e-9)};
}

Claim nonholonomic() {
  const DifferentialDrive at_axle;
  double sideways = 0;
  RandomStream random(1, "poses");
  for (int i = 0; i < 1000; ++i) {
    const Vector3d x(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3));
    const Vector2d u(random.uniform(-2, 2), random.uniform(-2, 2));
    const Vector2d moved = (at_axle.step(x, u, 1e-3).x - x).head<2>();
    sideways = std::max(sideways, std::abs(moved.dot(Vector2d(-std::sin(x[2]), std::cos(x[2])))) / 1e-3);
  }
  Vector3d x = Vector3d::Zero();  // ahead, turn, back, turn back: 0.3 s each
  for (const Vector2d& u : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(-1, 0), Vector2d(0, -1)})
    x = at_axle.step(x, u, 0.3).x;
  return assessed(
      "text-2.1-nonholonomic", "Section 2.1",
      "A wheeled vehicle cannot move sideways (below 1e-9 m/s), but its constraint cannot be integrated: "
      "driving and turning alternately leads sideways all the same",
      {.rule = Rule::example,
       .measured = {"fastest sideways in 1000 poses and inputs, in m/s, {}; after ahead, left, back, right "
                    "at 1 m/s and 1 rad/s, 0.3 s each: {:.3f} m sideways with the first heading",
                    below(sideways), x.y()},
       .number = exactly("sideways after driving and turning alternately", std::abs(x.y()), "m"),
       .runs = 1000},
      sideways <= 1e-9 && std::abs(x.y()) > 0.05 && std::abs(x[2]) < 1e-9);
}

/// 100 measurements after the first, from a start known to 0.5 m and 10 degrees.
StandingVehicle standing_run(std::uint64_t seed, double sigma_bearing_deg, Linearization linearization) {
  const double sigma_m = 0.5, sigma_deg = 10, sigma_rad = radians(sigma_deg);
  RandomStream random(seed, "standing");
  const Vector3d start(sigma_m * random.normal(), sigma_m * random.normal(), sigma_rad * random.normal());
  return standing_vehicle({linearization, start, sigma_m, sigma_deg, sigma_bearing_deg, 101}, random);
}

Claim stationary_vehicle(int seeds) {
  double off = 0;
  Interval sigma;
  const Cases optimistic = by_number({1, 3, 10}, [&](int bearing) -> CaseResult {
    const auto runs = [&](Linearization by) {
      return over_seeds(seeds, [&](std::uint64_t seed) { return standing_run(seed, bearing, by); });
    };
    const auto ekf = runs(Linearization::analytic), first_estimates = runs(Linearization::first_estimate);
    for (const auto& run : first_estimates) off = std::max(off, std::abs(run.sigma_heading_deg - 10));
    const Interval nees = bootstrap_mean(each(ekf, &StandingVehicle::nees));
    sigma = mean_of(each(ekf, &StandingVehicle::sigma_heading_deg));
    return {{"{}, NEES {}", text(sigma, "degrees"), text(nees)}, is_below(sigma, 10) && is_above(nees, 1)};
  });
  return assessed(
      "text-2.2.3-stationary", "Section 2.2.3 and head of Chapter 3",
      "The EKF of a stationary vehicle is optimistic, because Jacobians are evaluated at different estimates "
      "of the same state: sigma of its heading below the first and mean NEES above 1, and with Jacobians at the "
      "first estimates the sigma stays as it was (to 1e-6 degrees)",
      {.rule = Rule::superiority,
       .measured = {"heading known to 10 degrees, its sigma after 100 measurements by noise of the bearing "
                    "in degrees: {}; with Jacobians at the first estimates 10 in every run (difference {})",
                    optimistic.text(), below(off)},
       .number = ClaimNumber{"heading sigma from 10 degrees, bearings to 10 degrees", sigma, "degrees"},
       .seeds = seeds},
      optimistic.hold() && off < 1e-6);
}

}  // namespace

std::vector<Claim> chapter_2_claims(int seeds) {
  return concatenated({nonholonomic(), precision_increases(), vehicle_is_bounded(), correlations_grow(),
                       optimal(), joseph_form(), filter_in_one_step(), dependent_errors(),
                       stationary_vehicle(seeds), riccati_depends(), riccati_needs_observability(),
                       initial_covariance(), lower_bound(), bound_is_reached()});
}

}  // namespace incognita
