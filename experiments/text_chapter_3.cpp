// What the running text of Chapter 3 says outside its examples, and Chapter 1 of it.
//
// Experiment: the monobot of monobot.hpp, also with 2 to 5 landmarks, with and without the anchor, with and
// without noise on the landmarks (0.05 m a step); up to 10000 steps where limits are asked for.
// Holds: identities to 1e-12, limits to 1e-9 relative unless said; `goes to zero` when 100 times the steps
// leave less than a tenth; ranks by singular values; means over runs by their 99.9 % intervals.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "experiments/evidence.hpp"
#include "experiments/monobot.hpp"
#include "experiments/text_claims.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/planar_vehicle.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using monobot::Decorrelated;
using monobot::Setup;

constexpr double rounding = 1e-12;

MatrixXd start_of(const Setup& setup) { return monobot::first_covariance(setup); }

/// The posterior after so many steps.
MatrixXd after(const Setup& setup, int steps) {
  return filtered(monobot::system(setup), start_of(setup), steps);
}

/// With noise of 0.05 m a step on the landmarks.
LinearSystem with_noisy_landmarks(const Setup& setup) {
  const int n = monobot::states(setup);
  MatrixXd dP = 0.05 * 0.05 * MatrixXd::Identity(n, n);
  dP(0, 0) = 0;
  return monobot::with_pseudo_noise(monobot::system(setup), dP);
}

VectorXd eigenvalues(const MatrixXd& M) { return M.eigenvalues().cwiseAbs(); }

double smallest_eigenvalue(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

// The three properties at the head of Section 3.1 -----------------------------------------------------

Claim determinants_fall() {
  double rise = 0;
  int submatrices = 0;
  for (const bool initialized : {false, true}) {
    Setup setup{.landmarks = 4};
    if (initialized) setup.robot_var_m2 = 1, setup.landmark_var_m2.reset();
    const auto P = monobot::course(setup).posterior;
    for (unsigned chosen = 1; chosen < 16; ++chosen, ++submatrices) {
      std::vector<int> rows;
      for (int i = 0; i < 4; ++i)
        if (chosen >> i & 1) rows.push_back(1 + i);
      for (std::size_t k = 1; k < P.size(); ++k) {
        const double before = P[k - 1](rows, rows).determinant(), now = P[k](rows, rows).determinant();
        rise = std::max(rise, now / before - 1);
      }
    }
  }
  return assessed(
      {.id = "text-3.1-determinants",
       .place = "Section 3.1, property (1)",
       .statement = "The determinant of any submatrix of the map's covariance decreases monotonically",
       .printed = "decreases",
       .measured = fmt::format(
           "largest relative rise at a step, {} principal submatrices of four landmarks, 100 steps: {}",
           submatrices, below(rise))},
      rise <= rounding);
}

Claim fully_correlated() {
  std::vector<double> steps{100, 1000, 10'000}, missing, anchored;
  for (const double k : steps) {
    const auto correlation = [&](const MatrixXd& P) { return P(1, 2) / P(1, 1); };  // equal landmarks
    missing.push_back(1 - correlation(after({.landmarks = 2}, static_cast<int>(k))));
    anchored.push_back(correlation(after({.landmarks = 2, .anchored = true}, static_cast<int>(k))));
  }
  return assessed(
      {.id = "text-3.1-correlated",
       .place = "Section 3.1, property (2)",
       .statement =
           "In the limit the landmarks are fully correlated: what correlation lacks of 1 goes to zero",
       .printed = "1",
       .measured =
           fmt::format("1 - correlation of two landmarks after 100, 1000, 10000 steps: {:.2g}, {:.2g}, "
                       "{:.2g}, as step^{:.2f}. Not so with an anchor: correlation {:.2f} then",
                       missing[0], missing[1], missing[2], exponent_of(steps, missing), anchored[2])},
      missing[2] < 0.1 * missing[0]);
}

// Observability, controllability ----------------------------------------------------------------------

Claim four_kinds() {
  struct Kind {
    bool observable, noisy, bounded, regular;
  };
  std::vector<Kind> kinds;
  std::vector<std::string> lines;
  for (const bool anchored : {false, true})
    for (const bool noisy : {false, true}) {
      const Setup setup{.anchored = anchored};
      const LinearSystem s = noisy ? with_noisy_landmarks(setup) : monobot::system(setup);
      const MatrixXd at_100 = filtered(s, start_of(setup), 100), at_10000 = filtered(s, at_100, 9900);
      kinds.push_back({anchored, noisy, at_10000.trace() < 2 * at_100.trace(),
                       smallest_eigenvalue(at_10000) > 0.1 * smallest_eigenvalue(at_100)});
      lines.push_back(fmt::format(
          "{}, {}: trace {:.3g} to {:.3g} m^2, smallest eigenvalue {:.2g} to {:.2g} m^2",
          anchored ? "observable" : "not observable", noisy ? "controllable" : "not controllable",
          at_100.trace(), at_10000.trace(), smallest_eigenvalue(at_100), smallest_eigenvalue(at_10000)));
    }
  const bool as_said = std::all_of(kinds.begin(), kinds.end(), [](const Kind& k) {
    return (!k.observable || k.bounded) && (!k.noisy || k.regular);
  });
  return assessed(
      {.id = "text-3.1-two-conditions",
       .place = "Section 3.1",
       .statement = "Observability keeps the covariance from becoming unbounded, controllability "
                    "from becoming singular",
       .printed = "",
       .measured = fmt::format("between 100 and 10000 steps: {}. Neither is necessary: the monobot "
                               "without anchor and noise has none and stays bounded and regular",
                               fmt::join(lines, "; "))},
      as_said);
}

Claim unique_limit() {
  RandomStream random(1, "covariances");
  double spread = 0, least = 1e300;
  bool settled = true;
  for (const int n : {1, 2, 3}) {
    const Setup setup{.landmarks = n, .anchored = true};
    const LinearSystem s = with_noisy_landmarks(setup);
    MatrixXd first;
    for (int i = 0; i < 20; ++i) {
      const MatrixXd A = MatrixXd::NullaryExpr(n + 1, n + 1, [&] { return random.normal(); });
      const RiccatiLimit limit = iterate_riccati(s, 10 * A * A.transpose());
      settled = settled && limit.settled;
      if (i == 0) first = limit.P;
      spread = std::max(spread, (limit.P - first).norm() / first.norm());
      least = std::min(least, smallest_eigenvalue(limit.P));
    }
  }
  return assessed({.id = "text-3.1-unique",
                   .place = "head of Chapter 3, Section 3.1",
                   .statement = "Observable and controllable, the Riccati equation converges to a unique "
                                "positive definite solution, whatever the first covariance; to 1e-9",
                   .printed = "unique",
                   .measured = fmt::format("20 first covariances each, 1 to 3 landmarks: largest relative "
                                           "difference {}, smallest eigenvalue {:.4f} m^2",
                                           below(spread), least),
                   .runs = 60},
                  settled && spread <= 1e-9 && least > 1e-6);
}

Claim solutions_without_anchor() {
  const LinearSystem s = monobot::system({});
  const double p = monobot::relative_variance(0.1, 0.2);
  double off = 0;
  for (const double c : {0.0, 0.1, 1.0, 10.0}) {
    const MatrixXd P = MatrixXd::Constant(2, 2, c) + MatrixXd(Eigen::Vector2d(p, 0).asDiagonal());
    off = std::max(off, (predicted(s, updated(s, P, kalman_gain(s, P))) - P).norm() / P.norm());
  }
  return assessed(
      {.id = "text-3.5-psd-solution",
       .place = "Section 3.5",
       .statement =
           "Marginal stability leaves at least one positive semi-definite solution of the Riccati equation",
       .printed = "at least one",
       .measured = fmt::format(
           "[c+p c; c c] solves it for every c >= 0 (relative difference {}): from which start decides",
           below(off))},
      off <= rounding);
}

Claim uncorrupted_states() {
  const double free_100 = after({}, 100)(1, 1), free_10000 = after({}, 10'000)(1, 1);
  const double anchored_100 = after({.anchored = true}, 100)(1, 1),
               anchored_10000 = after({.anchored = true}, 10'000)(1, 1);
  return assessed(
      {.id = "text-3.1-uncorrupted",
       .place = "Section 3.1, Section 3.5",
       .statement = "Under partial controllability the variances of the states that no noise reaches are "
                    "driven to zero",
       .printed = "0 m^2",
       .measured = fmt::format(
           "the landmark's after 100 and 10000 steps: {:.4f}, {:.4f} m^2; with an anchor {:.1e}, {:.1e} m^2",
           free_100, free_10000, anchored_100, anchored_10000),
       .why = "only where they can be observed as well"},
      free_10000 < 0.1 * free_100, anchored_10000 < 0.1 * anchored_100);
}

Claim known_states_stay() {
  RandomStream random(1, "covariances");
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    const Setup setup{.landmarks = 1 + random.below(4), .anchored = random.below(2) == 1};
    const int n = monobot::states(setup);
    VectorXd known = VectorXd::NullaryExpr(n, [&] { return random.normal(); }).normalized();
    const MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return random.normal(); });
    const MatrixXd M = A - known * (known.transpose() * A);
    const MatrixXd K = kalman_gain(monobot::system(setup), M * M.transpose());
    largest = std::max(largest, (known.transpose() * K).norm());
  }
  return assessed(
      {.id = "text-3.1-known-states",
       .place = "Section 3.1",
       .statement = "For what a semi-definite covariance says is known perfectly the gain is zero, and the "
                    "estimate remains as it is; to 1e-12",
       .printed = "0",
       .measured = fmt::format("largest gain along the null vector of 200 covariances: {}", below(largest)),
       .runs = 200},
      largest <= rounding);
}

Claim controllable_dimension() {
  std::vector<std::string> lines;
  bool as_said = true;
  const DifferentialDrive drive{0.3, 0};
  for (const int n : {1, 2, 5, 10}) {
    const int line = rank_of(controllability_matrix(monobot::system({.landmarks = n}))).rank;
    const auto step = drive.step(Eigen::Vector3d(1, 2, 0.5), Eigen::Vector2d(1, 0.3), 0.5);
    LinearSystem plane;
    plane.F = MatrixXd::Identity(3 + 2 * n, 3 + 2 * n);
    plane.F.topLeftCorner<3, 3>() = step.F;
    plane.G = MatrixXd::Zero(3 + 2 * n, 2);
    plane.G.topRows<3>() = step.G;
    plane.Q = Eigen::Vector2d(0.01, 0.001).asDiagonal();
    plane.H = MatrixXd::Identity(1, 3 + 2 * n);
    plane.R = MatrixXd::Identity(1, 1);
    const int planar = rank_of(controllability_matrix(plane)).rank;
    lines.push_back(fmt::format("{}: {} and {}", n, line, planar));
    as_said = as_said && line == 1 && planar == 3;
  }
  return assessed(
      {.id = "text-3.3-controllable",
       .place = "(3.3)",
       .statement =
           "The controllable subspace has the dimension of the vehicle's state, however many landmarks",
       .printed = "dim x_r",
       .measured = fmt::format("rank for the monobot (1 state) and a vehicle of the plane in motion (3), by "
                               "number of landmarks: {}",
                               fmt::join(lines, "; "))},
      as_said);
}

// Error dynamics --------------------------------------------------------------------------------------

/// (3.2) against the engine: the errors of a run, with the noises that they came from.
Claim error_equation() {
  double off = 0;
  for (const bool anchored : {false, true})
    for (const int n : {1, 3}) {
      const Setup setup{.landmarks = n, .anchored = anchored};
      const LinearSystem s = monobot::system(setup);
      const auto gain = monobot::course(setup).gain;
      const monobot::Run run = monobot::simulate(setup, 1);
      const MatrixXd e = run.error();
      for (int k = 1; k <= setup.steps; ++k) {
        const VectorXd v = run.truth.col(k) - run.truth.col(k - 1),
                       w = run.measurement.col(k) - s.H * run.truth.col(k);
        const VectorXd next =
            error_dynamics(s, gain[k]) * e.col(k - 1) + v - gain[k] * (s.H * v) - gain[k] * w;
        off = std::max(off, (next - e.col(k)).cwiseAbs().maxCoeff());
      }
    }
  return assessed(
      {.id = "text-3.2-dynamics",
       .place = "(3.2)",
       .statement = "e_{k+1} = (F - KHF) e_k + (I - KH) v_k - K w_{k+1}, to 1e-12",
       .printed = "",
       .measured = fmt::format(
           "largest difference from the engine's errors, four runs of 100 steps, in m: {}", below(off))},
      off <= rounding);
}

Claim one_pole() {
  std::vector<std::string> lines;
  bool one = true;
  for (const int n : {1, 2, 5, 10}) {
    const LinearSystem s = monobot::system({.landmarks = n});
    const auto poles = [&](int steps) {
      return eigenvalues(error_dynamics(s, kalman_gain(s, predicted(s, after({.landmarks = n}, steps)))));
    };
    const VectorXd at_100 = poles(100);
    const auto on_circle = (at_100.array() > 1 - 1e-6).count();
    lines.push_back(fmt::format("{}: {}", n, on_circle));
    one = one && on_circle == 1 && at_100.maxCoeff() < 1 + 1e-9;
  }
  return assessed(
      {.id = "text-3.1-one-pole",
       .place = "Section 3.1, Section 3.5",
       .statement = "Partial observability puts one eigenvalue of F - KHF on the unit circle (to "
                    "1e-6), for any number of landmarks",
       .printed = "one",
       .measured = fmt::format("on the circle after 100 steps, by number of landmarks: {}. With n "
                               "landmarks n - 1 more go there as one over the number of steps",
                               fmt::join(lines, "; "))},
      one);
}

Claim stays_where_it_was_born(int seeds) {
  const auto runs = monobot::simulate_all({.steps = 1000}, seeds);
  double moved = 0;
  for (const auto& run : runs)
    moved = std::max(moved, std::abs(run.estimate(1, 1000) - run.estimate(1, 100)));
  const auto last = monobot::errors(runs, 1, 1000);
  return assessed(
      {.id = "text-3.5-constant-error",
       .place = "Sections 3.1 and 3.5",
       .statement =
           "The estimation error converges to a constant of non-zero mean: over 900 more steps no run's "
           "landmark moves by 1e-9 m, and the mean over runs of what is left is not 0 to 0.03 m",
       .printed = "non-zero-mean constant",
       .measured = fmt::format("largest move, in m, {}; rms over runs {}. The constant is one of each run: "
                               "its mean over runs is {}",
                               below(moved), text(rms_of(last), "m"), text(mean_of(last), "m")),
       .why = "each run keeps a constant that is not zero (rms above 0.05 m); over runs its mean is zero, "
              "because the "
              "first estimates err to either side",
       .runs = seeds,
       .least_runs = enough_runs},
      moved < 1e-9 && !agrees(mean_of(last), 0, 0.03), moved < 1e-9 && is_above(rms_of(last), 0.05));
}

Claim first_observation() {
  const auto left = [](bool anchored, int step) {
    const Setup as_it_is{.anchored = anchored, .steps = 1000};
    Setup misled = as_it_is;
    misled.first_measurement_error_m = 1;
    return std::abs(simulate(misled, 1).estimate(1, step) - simulate(as_it_is, 1).estimate(1, step));
  };
  const double free_100 = left(false, 100), free_1000 = left(false, 1000), anchored_100 = left(true, 100),
               anchored_1000 = left(true, 1000);
  return assessed(
      {.id = "text-3.5-first-look",
       .place = "head of Chapter 3, Sections 2.2.1 and 3.5",
       .statement = "Partial observability makes the final map depend on the first observations: "
                    "an error of 1 m in the first look is not forgotten, and with an anchor it is",
       .printed = "",
       .measured = fmt::format("left in the landmark after 100 and 1000 steps: {:.4f} and {:.4f} "
                               "m; with an anchor {:.4f} and {:.4f} m",
                               free_100, free_1000, anchored_100, anchored_1000)},
      free_1000 > 0.99 * free_100 && free_1000 > 0.01 && anchored_1000 < 0.2 * anchored_100);
}

Claim unstable_system() {
  LinearSystem s = monobot::system({.anchored = true});
  s.F(0, 0) = 1.1;
  MatrixXd P = Eigen::Vector2d(1, 1).asDiagonal(), kept = MatrixXd::Identity(2, 2);
  double at_100 = 0;
  for (int k = 1; k <= 10'000; ++k) {
    P = predicted(s, P);
    const MatrixXd K = kalman_gain(s, P);
    P = updated(s, P, K);
    kept = error_dynamics(s, K) * kept;
    if (k == 100) at_100 = kept.norm();
  }
  return assessed(
      {.id = "text-3.1-unstable",
       .place = "Section 3.1",
       .statement = "Asymptotic stability of the filter needs observability, not a stable system: the first "
                    "error goes to zero even when the robot's own grows by a tenth each step",
       .printed = "stable",
       .measured = fmt::format("norm of what is left of the first error after 100 and 10000 steps, with an "
                               "anchor: {:.1e}, {:.1e}",
                               at_100, kept.norm())},
      kept.norm() < 0.1 * at_100);
}

/// Sees all landmarks relative to the vehicle and has no other states.
LinearSystem relative(int landmarks) {
  LinearSystem s;
  s.F = s.H = MatrixXd::Identity(landmarks, landmarks);
  s.G = -VectorXd::Ones(landmarks);
  s.Q = MatrixXd::Constant(1, 1, 0.1 * 0.1);
  s.R = 0.2 * 0.2 * MatrixXd::Identity(landmarks, landmarks);
  return s;
}

Claim remedies() {
  LinearSystem fixed = monobot::system({.landmarks = 3});  // the first landmark's place is given
  fixed.F = MatrixXd::Identity(3, 3);
  fixed.G = VectorXd::Unit(3, 0);
  fixed.H = (MatrixXd(3, 3) << -1, 0, 0, -1, 1, 0, -1, 0, 1).finished();
  LinearSystem watched = monobot::system({.landmarks = 3});  // somebody else sees the vehicle
  watched.H = (MatrixXd(4, 4) << 1, 0, 0, 0, -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1).finished();
  watched.R = 0.2 * 0.2 * MatrixXd::Identity(4, 4);
  std::vector<std::string> lines;
  bool all = true;
  const auto try_it = [&](const std::string& name, const LinearSystem& s) {
    const auto n = s.F.rows();
    const int rank = rank_of(observability_matrix(s)).rank;
    const MatrixXd P = filtered(s, MatrixXd::Identity(n, n), 100);
    const double largest = eigenvalues(error_dynamics(s, kalman_gain(s, predicted(s, P)))).maxCoeff();
    lines.push_back(
        fmt::format("{}: rank {} of {}, largest eigenvalue after 100 steps {:.4f}", name, rank, n, largest));
    all = all && rank == n && largest < 1 - 1e-6;
  };
  try_it("first landmark as anchor", fixed);
  try_it("outside sensor", watched);
  try_it("relative map", relative(3));
  return assessed(
      {.id = "text-3.5-remedies",
       .place = "Sections 3.1, 3.2 and 3.5",
       .statement = "Anchoring the map to the first landmark, a sensor that sees the vehicle, or landmarks "
                    "relative to the vehicle make the system observable and its filter stable",
       .printed = "",
       .measured = fmt::format("three landmarks: {}", fmt::join(lines, "; "))},
      all);
}

// Landmarks -------------------------------------------------------------------------------------------

Claim map_determinant() {
  std::vector<std::string> lines;
  bool one = true, more = true;
  for (const int n : {1, 2, 3}) {
    const auto determinant = [&](int steps) {
      return after({.landmarks = n}, steps).bottomRightCorner(n, n).determinant();
    };
    const double at_100 = determinant(100), at_10000 = determinant(10'000);
    lines.push_back(fmt::format("{}: {:.1e}, {:.1e} m^{}", n, at_100, at_10000, 2 * n));
    (n == 1 ? one : more) = (n == 1 ? true : more) && at_10000 < 0.1 * at_100;
  }
  return assessed(
      {.id = "text-3.1-map-determinant",
       .place = "Section 3.1",
       .statement = "The determinant of the landmarks' covariance approaches zero",
       .printed = "0",
       .measured =
           fmt::format("after 100 and 10000 steps, by number of landmarks: {}", fmt::join(lines, "; ")),
       .why =
           "from two landmarks on, because their differences become certain; one alone keeps its variance"},
      one && more, more);
}

Claim perfect_relative_map() {
  const VectorXd difference = (VectorXd(4) << 0, 1, -1, 0).finished();
  const auto variance = [&](int steps) {
    return difference.dot(after({.landmarks = 3}, steps) * difference);
  };
  const double at_100 = variance(100), at_10000 = variance(10'000);
  return assessed(
      {.id = "text-3.1-relative-map",
       .place = "below Example 3.2",
       .statement =
           "A perfect relative map is produced: the variance of the distance of two landmarks goes to zero",
       .printed = "0",
       .measured = fmt::format("after 100 and 10000 steps: {:.2e}, {:.2e} m^2", at_100, at_10000)},
      at_10000 < 0.1 * at_100);
}

Claim landmarks_stop_moving() {
  // what updates after step 20 still take off the variance is the mean square of how far they move the
  // estimate
  std::vector<std::string> lines;
  bool all = true;
  for (const bool anchored : {false, true})
    for (const int n : {1, 2}) {
      const Setup setup{.landmarks = n, .anchored = anchored};
      const double at_20 = after(setup, 20)(1, 1), at_1000 = after(setup, 1000)(1, 1);
      const double share = std::sqrt(std::max(0.0, at_20 - at_1000) / at_20);
      lines.push_back(fmt::format("{}{}: {:.2g}", n, anchored ? " and an anchor" : "", share));
      all = all && share < 0.01;
    }
  return assessed(
      {.id = "text-3-small-number",
       .place = "head of Chapter 3",
       .statement = "Updates do not change the landmark estimates after just a small number of iterations, "
                    "in Sections 3.1 and 3.2; tested: from step 20 to 1000 they move by less than 1 % of "
                    "their sigma at 20",
       .printed = "not",
       .measured = fmt::format("rms move in sigmas, by number of landmarks: {}", fmt::join(lines, "; ")),
       .why = "only one landmark without an anchor settles geometrically. Otherwise gains fall as one over "
              "the number of steps, whose sum has no bound: with an anchor nearly all of the error that is "
              "left at step 20 is taken off later"},
      all);
}

// Pseudo-noise and decorrelation ----------------------------------------------------------------------

Claim pseudo_noise_controls() {
  std::vector<std::string> lines;
  bool full = true;
  for (const int n : {1, 2, 5}) {
    const int without = rank_of(controllability_matrix(monobot::system({.landmarks = n}))).rank;
    const int with = rank_of(controllability_matrix(with_noisy_landmarks({.landmarks = n}))).rank;
    lines.push_back(fmt::format("{}: {} and {} of {}", n, without, with, n + 1));
    full = full && with == n + 1;
  }
  return assessed(
      {.id = "text-3.3-pseudo-noise",
       .place = "Section 3.3",
       .statement = "Pseudo-noise on the landmark states makes the system controllable",
       .printed = "rank n + 1",
       .measured = fmt::format("rank without and with, by number of landmarks: {}", fmt::join(lines, "; "))},
      full);
}

Claim pseudo_noise_remedies() {
  std::vector<std::string> lines;
  bool settled = true, drifts_as_predicted = true, anchored_settles = true;
  for (const int n : {1, 3}) {
    const Setup setup{.landmarks = n};
    const LinearSystem free = with_noisy_landmarks(setup),
                       anchored = with_noisy_landmarks({.landmarks = n, .anchored = true});
    const MatrixXd at_1000 = filtered(free, start_of(setup), 1000), at_2000 = filtered(free, at_1000, 1000);
    const double drift = (at_2000 - at_1000)(1, 1) / 1000, q = 0.05 * 0.05, v2 = 0.1 * 0.1;
    const double predicted_drift = 1 / (1 / v2 + n / q);
    settled = settled && drift < 1e-3 * predicted_drift;
    drifts_as_predicted = drifts_as_predicted && std::abs(drift / predicted_drift - 1) < 1e-6;
    const RiccatiLimit limit = iterate_riccati(anchored, start_of(setup));
    anchored_settles = anchored_settles && limit.settled && limit.K(1, 1) > 1e-3;
    lines.push_back(
        fmt::format("{}: {:.2e} m^2 a step, with an anchor gain {:.3f}", n, drift, limit.K(1, 1)));
  }
  return assessed({.id = "text-3.5-pseudo-noise",
                   .place = "Sections 3.1 and 3.5",
                   .statement = "That gains go to zero is remedied by pseudo-noise on the landmark states: "
                                "gains settle above zero, and the covariance settles",
                   .printed = "remedied",
                   .measured = fmt::format(
                       "growth of the landmarks' variance without an anchor, by number of landmarks: {}",
                       fmt::join(lines, "; ")),
                   .why = "only with an anchor. Without, all drift together without bound, by 1/(1/s_v^2 + "
                          "n/q) a step where q is the noise on each landmark"},
                  settled && anchored_settles, drifts_as_predicted && anchored_settles);
}

Claim decorrelation_needs_observability() {
  const auto growth = [](bool anchored) {
    const Setup setup{.anchored = anchored, .decorrelated = Decorrelated::everything, .steps = 1000};
    const auto P = monobot::course(setup).posterior;
    return P[1000].trace() / P[500].trace();
  };
  const double free = growth(false), anchored = growth(true);
  return assessed(
      {.id = "text-1-decorrelation",
       .place = "Section 1.4, Section 2.2.1",
       .statement = "Whether decorrelating the covariance is stable depends on whether the system is "
                    "observable: full decorrelation diverges without the anchor and not with it",
       .printed = "",
       .measured = fmt::format("trace after 1000 steps over that after 500: {:.3f} without, {:.3f} with",
                               free, anchored)},
      free > 1.5 && anchored < 1.01);
}

}  // namespace

std::vector<Claim> chapter_3_claims(int seeds) {
  return {decorrelation_needs_observability(),
          determinants_fall(),
          fully_correlated(),
          four_kinds(),
          unique_limit(),
          uncorrupted_states(),
          known_states_stay(),
          unstable_system(),
          error_equation(),
          one_pole(),
          stays_where_it_was_born(seeds),
          first_observation(),
          controllable_dimension(),
          map_determinant(),
          perfect_relative_map(),
          landmarks_stop_moving(),
          pseudo_noise_controls(),
          pseudo_noise_remedies(),
          remedies(),
          solutions_without_anchor()};
}

}  // namespace incognita
