// Claims in the running text of Chapter 3 outside its examples, and of Chapter 1 about it: the Riccati
// equation, observability, controllability and the stability of the filter (Section 3.1). The rest is in
// text_chapter_3_landmarks.cpp.
//
// Experiment: the monobot of monobot.hpp, also with 2 to 5 landmarks, with and without the anchor, with and
// without noise on the landmarks (0.05 m a step); up to 10000 steps where limits are asked for. Holds:
// identities to 1e-12, limits to 1e-9 relative unless said; `goes to zero` when 100 times the steps leave
// less than a tenth; ranks by singular values; means over runs by their intervals.
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"
#include "experiments/text_claims.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {
namespace {

using namespace monobot;

// The three properties at the head of Section 3.1 -----------------------------------------------------

Claim determinants_fall() {
  double rise = 0;
  int submatrices = 0;
  for (const Setup& setup :
       {Setup{.landmarks = 4}, Setup{.landmarks = 4, .robot_var_m2 = 1, .landmark_var_m2 = {}}}) {
    const auto P = course(setup).posterior;
    for (unsigned chosen = 1; chosen < 16; ++chosen, ++submatrices) {
      std::vector<int> rows;
      for (int i = 0; i < 4; ++i)
        if (chosen >> i & 1) rows.push_back(1 + i);
      for (std::size_t k = 1; k < P.size(); ++k)
        rise = std::max(rise, P[k](rows, rows).determinant() / P[k - 1](rows, rows).determinant() - 1);
    }
  }
  return assessed(
      "text-3.1-determinants", "Section 3.1, property (1)",
      "The determinant of any submatrix of the map's covariance decreases monotonically",
      {.printed = "decreases",
       .measured =
           {"largest relative rise at a step, {} principal submatrices of four landmarks, 100 steps: {}",
            submatrices, below(rise)}},
      rise <= rounding_error);
}

Claim fully_correlated() {
  std::vector<double> steps{100, 1000, 10'000}, missing, anchored;
  for (const double k : steps) {
    const auto correlation = [&](const MatrixXd& P) { return P(1, 2) / P(1, 1); };  // equal landmarks
    missing.push_back(1 - correlation(after({.landmarks = 2}, static_cast<int>(k))));
    anchored.push_back(correlation(after({.landmarks = 2, .anchored = true}, static_cast<int>(k))));
  }
  return assessed("text-3.1-correlated", "Section 3.1, property (2)",
                  "In the limit the landmarks are fully correlated: 1 - correlation goes to zero",
                  {.printed = "1",
                   .measured = {"1 - correlation of two landmarks after 100, 1000, 10000 steps: {:.2g}, as "
                                "step^{:.2f}. Not so with an anchor: correlation {:.2f} then",
                                fmt::join(missing, ", "), exponent_of(steps, missing), anchored[2]}},
                  missing[2] < 0.1 * missing[0]);
}

// Observability, controllability ----------------------------------------------------------------------

Claim four_kinds() {
  Cases cases;
  for (const bool anchored : {false, true})
    for (const bool noisy : {false, true}) {
      const Setup setup{.anchored = anchored};
      const LinearSystem s = noisy ? with_noisy_landmarks(setup) : system(setup);
      const MatrixXd at_100 = filtered(s, start_of(setup), 100), at_10000 = filtered(s, at_100, 9900);
      const double least_100 = smallest_eigenvalue(at_100), least_10000 = smallest_eigenvalue(at_10000);
      const bool bounded = at_10000.trace()<2 * at_100.trace(), regular = least_10000> 0.1 * least_100;
      cases.add({{"{}, {}: trace {:.3g} to {:.3g} m^2, smallest eigenvalue {:.2g} to {:.2g} m^2",
                  anchored ? "observable" : "not observable", noisy ? "controllable" : "not controllable",
                  at_100.trace(), at_10000.trace(), least_100, least_10000},
                 (!anchored || bounded) && (!noisy || regular)});
    }
  return assessed(
      "text-3.1-two-conditions", "Section 3.1",
      "Observability keeps the covariance from becoming unbounded, controllability from becoming singular",
      {.measured = {"between 100 and 10000 steps: {}. Neither is necessary: the monobot without anchor and "
                    "noise has none and stays bounded and regular",
                    cases.text()}},
      cases.hold());
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
      spread = std::max(spread, relative_difference(limit.P, first));
      least = std::min(least, smallest_eigenvalue(limit.P));
    }
  }
  return assessed("text-3.1-unique", "head of Chapter 3, Section 3.1",
                  "Observable and controllable, the Riccati equation converges to a unique positive definite "
                  "solution, whatever the first covariance; to 1e-9",
                  {.printed = "unique",
                   .measured = {"20 first covariances each, 1 to 3 landmarks: largest relative difference "
                                "{}, smallest eigenvalue {:.4f} m^2",
                                below(spread), least},
                   .runs = 60},
                  settled && spread <= 1e-9 && least > 1e-6);
}

Claim uncorrupted_states() {
  const double free_100 = after({}, 100)(1, 1), free_10000 = after({}, 10'000)(1, 1);
  const double anchored_100 = after({.anchored = true}, 100)(1, 1),
               anchored_10000 = after({.anchored = true}, 10'000)(1, 1);
  return assessed(
      "text-3.1-uncorrupted", "Section 3.1, Section 3.5",
      "Under partial controllability the variances of the states that no noise reaches are driven to zero",
      {.printed = "0 m^2",
       .measured =
           {"the landmark's after 100 and 10000 steps: {:.4f}, {:.4f} m^2; with an anchor {:.1e}, {:.1e} m^2",
            free_100, free_10000, anchored_100, anchored_10000},
       .why = "only where they can be observed as well"},
      free_10000 < 0.1 * free_100, anchored_10000 < 0.1 * anchored_100);
}

Claim known_states_stay() {
  RandomStream random(1, "covariances");
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    const Setup setup{.landmarks = 1 + random.below(4), .anchored = random.below(2) == 1};
    const int n = states(setup);
    VectorXd known = VectorXd::NullaryExpr(n, [&] { return random.normal(); }).normalized();
    const MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return random.normal(); });
    const MatrixXd M = A - known * (known.transpose() * A);
    const MatrixXd K = kalman_gain(system(setup), M * M.transpose());
    largest = std::max(largest, (known.transpose() * K).norm());
  }
  return assessed("text-3.1-known-states", "Section 3.1",
                  "For states that are known perfectly by a semi-definite covariance the gain is zero, and "
                  "the estimate remains as it is; to 1e-12",
                  {.printed = "0",
                   .measured = {"largest gain along the null vector of 200 covariances: {}", below(largest)},
                   .runs = 200},
                  largest <= rounding_error);
}

// Error dynamics --------------------------------------------------------------------------------------

/// (3.2) against the engine: the errors of a run, with the noises that they came from.
Claim error_equation() {
  double off = 0;
  for (const bool anchored : {false, true})
    for (const int n : {1, 3}) {
      const Setup setup{.landmarks = n, .anchored = anchored};
      const LinearSystem s = system(setup);
      const auto gain = course(setup).gain;
      const Run run = simulate(setup, 1);
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
      "text-3.2-dynamics", "(3.2)", "e_{k+1} = (F - KHF) e_k + (I - KH) v_k - K w_{k+1}, to 1e-12",
      {.measured = {"largest difference from the engine's errors, four runs of 100 steps, in m: {}",
                    below(off)}},
      off <= rounding_error);
}

Claim one_pole() {
  const Cases cases = by_number({1, 2, 5, 10}, [](int n) -> CaseResult {
    const LinearSystem s = system({.landmarks = n});
    const MatrixXd K = kalman_gain(s, predicted(s, after({.landmarks = n}, 100)));
    const VectorXd poles = eigenvalues(error_dynamics(s, K));
    const auto on_circle = (poles.array() > 1 - 1e-6).count();
    return {std::to_string(on_circle), on_circle == 1 && poles.maxCoeff() < 1 + 1e-9};
  });
  return assessed("text-3.1-one-pole", "Section 3.1, Section 3.5",
                  "Partial observability puts one eigenvalue of F - KHF on the unit circle (to 1e-6), for "
                  "any number of landmarks",
                  {.printed = "one",
                   .measured = {"on the circle after 100 steps, by number of landmarks: {}. With n landmarks "
                                "n - 1 more go there as one over the number of steps",
                                cases.text()}},
                  cases.hold());
}

Claim unstable_system() {
  LinearSystem s = system({.anchored = true});
  s.F(0, 0) = 1.1;
  MatrixXd P = Vector2d(1, 1).asDiagonal(), kept = MatrixXd::Identity(2, 2);
  double at_100 = 0;
  for (int k = 1; k <= 10'000; ++k) {
    P = predicted(s, P);
    const MatrixXd K = kalman_gain(s, P);
    P = updated(s, P, K);
    kept = error_dynamics(s, K) * kept;
    if (k == 100) at_100 = kept.norm();
  }
  return assessed("text-3.1-unstable", "Section 3.1",
                  "Asymptotic stability of the filter needs observability, not a stable system: the first "
                  "error goes to zero even when the robot's own grows by a tenth each step",
                  {.printed = "stable",
                   .measured = {"norm of what is left of the first error after 100 and 10000 steps, with an "
                                "anchor: {:.1e}, {:.1e}",
                                at_100, kept.norm()}},
                  kept.norm() < 0.1 * at_100);
}

Claim decorrelation_needs_observability() {
  const auto growth = [](bool anchored) {
    const Setup setup{.anchored = anchored, .decorrelated = Decorrelated::everything, .steps = 1000};
    const auto P = course(setup).posterior;
    return P[1000].trace() / P[500].trace();
  };
  const double free = growth(false), anchored = growth(true);
  return assessed("text-1-decorrelation", "Section 1.4, Section 2.2.1",
                  "Whether decorrelating the covariance is stable depends on whether the system is "
                  "observable: full decorrelation diverges without the anchor and not with it",
                  {.measured = {"trace after 1000 steps over that after 500: {:.3f} without, {:.3f} with",
                                free, anchored}},
                  free > 1.5 && anchored < 1.01);
}

}  // namespace

std::vector<Claim> chapter_3_stability_claims() {
  return concatenated({decorrelation_needs_observability(), determinants_fall(), fully_correlated(),
                       four_kinds(), unique_limit(), uncorrupted_states(), known_states_stay(),
                       unstable_system(), error_equation(), one_pole()});
}

}  // namespace incognita
