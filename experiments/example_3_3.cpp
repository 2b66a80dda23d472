// Example 3.3: the same monobot with an anchor at the origin. Everything can be observed; the landmark still
// cannot be controlled.
//
// Experiment: monobot.hpp, with 1 and 2 landmarks and the anchor, 100 steps; up to 10000 where limits are
// asked for. Measured: the printed gains against the filter's own, eigenvalues of F - KHF (no chance in
// them), and errors over seeds 1, 2, ... Holds: an equation to 1e-12 relative; an eigenvalue inside (0, 1); a
// mean within 0.03 m of 0; what is forgotten when less than 2 % of it is left after 1000
// steps.
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"

namespace incognita {
namespace {

using namespace monobot;

LinearSystem anchored_system(double v, double w) {
  return monobot::system({.anchored = true, .sigma_v_m = v, .sigma_w_m = w});
}

/// Of F - KHF, ascending. They are real: F - KHF is I - KH here, a product of two covariances' root and
/// inverse.
Vector2d eigenvalues(const LinearSystem& s, const MatrixXd& K) {
  Vector2d values = Matrix2d(error_dynamics(s, K)).eigenvalues().real();
  std::sort(values.begin(), values.end());
  return values;
}

/// (3.14), (3.15); `misprint` as the first term of k11 has it: 4 s_v s_w^2.
Matrix2d closed_form_gain(double v, double w, bool misprint) {
  const double v2 = v * v, w2 = w * w, w4 = w2 * w2;
  const double gamma = w4 * w2 + 2 * v2 * w4 + 6 * w4 + 7 * v2 * w2 + 4 * w2 + 4 * v2;
  Matrix2d K;
  K << -(w4 + v2 * w4 + 4 * (misprint ? v : v2) * w2 + 2 * w2 + 3 * v2), -(w4 + v2 + 3 * v2 * w2 + v2 * w4),
      -(2 * w2 + v2 * w2 + 2 * v2), w4 + 2 * w2 + v2 * w2 + 2 * v2;
  return K / gamma;
}

/// The gain after one update and one prediction from P.
MatrixXd gain_of_second_step(const LinearSystem& s, const MatrixXd& P) {
  return kalman_gain(s, predicted(s, updated(s, P, kalman_gain(s, P))));
}

Claim full_rank() {
  const Cases cases = by_number({1, 2, 5, 10}, [](int n) -> CaseResult {
    const Rank anchored = rank_of(observability_matrix(monobot::system({.landmarks = n, .anchored = true})));
    const Rank free = rank_of(observability_matrix(monobot::system({.landmarks = n})));
    return {{"{} of {} (without {})", anchored.rank, n + 1, free.rank}, anchored.rank == n + 1};
  });
  return assessed(
      "3.3-observable", "below (3.12), Example 3.3", "With the anchor the observability matrix has full rank",
      {.rule = Rule::dimension, .measured = "rank by number of landmarks: " + cases.text()}, cases.hold());
}

Claim closed_form_gains() {
  Worst worst;
  double of_example = 0;
  for (const double v : {0.05, 0.1, 0.5, 2.0})
    for (const double w : {0.05, 0.2, 1.0, 2.0}) {
      const LinearSystem s = anchored_system(v, w);
      const MatrixXd K = gain_of_second_step(s, Matrix2d::Identity()), ours = closed_form_gain(v, w, false);
      worst.take(relative_difference(closed_form_gain(v, w, true), K), relative_difference(ours, K));
      const MatrixXd elsewhere = gain_of_second_step(s, Vector2d(0, 1).asDiagonal().toDenseMatrix());
      of_example = std::max(of_example, relative_difference(ours, elsewhere));
    }
  return assessed(
      "3.3-gains", "(3.14), (3.15), Example 3.3",
      "These are the gains of the second step from the covariance I, to 1e-12",
      {.printed = "4 s_v s_w^2 in k11",
       .measured =
           {"with s_v 0.1 m, s_w 0.2 m k11 printed {:.4f}, in truth {:.4f}. Largest relative difference over "
            "16 pairs of noises: {}. From the diag(0, 1) of Example 3.1 the corrected ones differ by up to "
            "{:.2g}",
            closed_form_gain(0.1, 0.2, true)(0, 0),
            gain_of_second_step(anchored_system(0.1, 0.2), Matrix2d::Identity())(0, 0), worst.text(),
            of_example},
       .number = exactly("largest relative difference of the printed gains", worst.printed),
       .why = "4 s_v^2 s_w^2 in k11"},
      worst.printed <= 1e-12, as_corrected(worst.ours <= 1e-12));
}

Claim inside_the_circle() {
  Extremes inside;
  for (int i = 1; i <= 40; ++i)
    for (int j = 1; j <= 40; ++j) {
      const double v = 0.05 * i, w = 0.05 * j;
      const Vector2d values = eigenvalues(anchored_system(v, w), closed_form_gain(v, w, false));
      inside.take(values[0]), inside.take(values[1]);
    }
  return assessed(
      "3.3-inside", "Figure 3.7, Example 3.3", "With those gains no eigenvalue of F - KHF reaches 0 or 1",
      {.rule = Rule::example,
       .measured = {"between {:.4f} and {:.4f} over s_v and s_w from 0.05 to 2 m", inside.least, inside.most},
       .number = exactly("largest eigenvalue", inside.most)},
      inside.least > 0 && inside.most < 1);
}

Claim inside_at_every_step() {
  RandomStream random(1, "noises");
  Extremes inside;
  for (int i = 0; i < 200; ++i) {
    const LinearSystem s = anchored_system(random.uniform(0.02, 2), random.uniform(0.02, 2));
    MatrixXd P = predicted(s, Vector2d(0, 1).asDiagonal().toDenseMatrix());
    for (int k = 0; k < 1000; ++k) {
      const MatrixXd K = kalman_gain(s, P);
      if (k % 100 == 99 || k < 3) {
        const Vector2d values = eigenvalues(s, K);
        inside.take(values[0]), inside.take(values[1]);
      }
      P = predicted(s, updated(s, P, K));
    }
  }
  return assessed("3.3-any-noise", "below (3.15), Section 3.2",
                  "The observability matrix having full rank, the eigenvalues of F - KHF are inside the "
                  "circle for any Q and R; tested at steps 1 to 1000 of 200 pairs of noises",
                  {.rule = Rule::example,
                   .measured = {"between {:.2g} and {:.5f}", inside.least, inside.most},
                   .number = exactly("largest eigenvalue", inside.most)},
                  inside.least > 0 && inside.most < 1);
}

Claim inside_in_the_limit() {
  const LinearSystem s = anchored_system(0.1, 0.2);
  const MatrixXd first = predicted(s, first_covariance({.anchored = true}));
  const std::vector<double> steps{100, 1000, 10'000};
  std::vector<double> landmark_gains;
  const std::vector<double> from_one = each(steps, [&](double k) {
    const MatrixXd K = iterate_riccati(s, first, {.max_iterations = static_cast<int>(k)}).K;
    landmark_gains.push_back(K.row(1).cwiseAbs().maxCoeff());
    return 1 - eigenvalues(s, K)[1];
  });
  const LinearSystem noisy = with_noisy_landmarks({.anchored = true});
  const RiccatiLimit with_noise = iterate_riccati(noisy, first);
  const double away = 1 - eigenvalues(noisy, with_noise.K)[1];
  return assessed(
      "3.3-limit-inside", "below (3.15), Section 3.2",
      "In the steady state, too, full observability keeps the eigenvalues off 1: the distance from 1 does not go to "
      "zero (100 times the steps leave more than a tenth)",
      {.rule = Rule::superiority,
       .measured =
           {"1 - eigenvalue after 100, 1000, 10000 steps: {:.3g}: it falls as step^{:.2f}. With noise of 0.05 "
            "m a step on the landmark it settles at {:.3f}",
            fmt::join(from_one, ", "), exponent_of(steps, from_one), away},
       .number = exactly("1 - eigenvalue after 10000 steps", from_one[2]),
       .why =
           "no process noise reaches the landmark: its gain goes to zero and its eigenvalue to 1. With noise on "
           "the landmark it stays away from 1"},
      !vanishes(from_one[0], from_one[2]),
      in_truth(vanishes(from_one[0], from_one[2]) && vanishes(landmark_gains[0], landmark_gains[2]) &&
               with_noise.settled && away > 0.01));
}

Claim forgets_the_start(int seeds) {
  const Setup as_it_is{.anchored = true, .steps = 1000},
      shifted{.anchored = true, .steps = 1000, .shift_m = 1};
  const MatrixXd left = (simulate(as_it_is, 1).error() - simulate(shifted, 1).error()).cwiseAbs();
  Cases means;
  Interval of_landmark;
  for (const int n : {1, 2}) {
    const auto runs = simulate_all({.landmarks = n, .anchored = true}, seeds);
    for (const int state : {0, 1}) {
      const Interval mean = mean_of(errors(runs, state, 100));
      if (n == 1 && state == 1) of_landmark = mean;
      means.add(
          {{"{} with {}: {}", state == 0 ? "robot" : "landmark", n, text(mean, "m")}, agrees(mean, 0, 0.03)});
    }
  }
  return assessed(
      "3.3-zero-mean", "above Example 3.4, Figure 3.8 (b), (c)",
      "The errors converge to zero mean: of first estimates that are all wrong by 1 m less than 2 % is left after "
      "1000 steps, in a landmark less than a tenth of what is left after 10, and the mean error over runs is 0 "
      "after 100 steps, to 0.03 m",
      {.rule = Rule::equality,
       .measured = {"of 1 m there is left after 10, 100, 1000 steps: robot {:.2g}, {:.2g}, {:.2g} m, "
                    "landmark {:.2g}, {:.2g}, {:.2g} m. Means: {}",
                    left(0, 10), left(0, 100), left(0, 1000), left(1, 10), left(1, 100), left(1, 1000),
                    means.text()},
       .number = ClaimNumber{"landmark's mean error after 100 steps", of_landmark, "m"},
       .seeds = seeds},
      left.col(1000).maxCoeff() < 0.02 && vanishes(left(1, 10), left(1, 1000)) && means.hold());
}

Claim smaller_variances() {
  const Cases cases = by_number({1, 2}, [](int n) -> CaseResult {
    const auto anchored = course({.landmarks = n, .anchored = true}).posterior,
               free = course({.landmarks = n}).posterior;
    return {{"robot {:.4f} against {:.4f} m^2, landmark {:.5f} against {:.4f} m^2", anchored[100](0, 0),
             free[100](0, 0), anchored[100](1, 1), free[100](1, 1)},
            monobot::smaller_variances(anchored, free)};
  });
  return assessed("3.3-variance", "above Example 3.4, Figure 3.8",
                  "Robot and landmark variances are smaller than without an anchor, at every step",
                  {.rule = Rule::superiority,
                   .measured = "after 100 steps, by number of landmarks: " + cases.text(),
                   .number = exactly("landmark's variance after 100 steps over that without an anchor",
                                     after({.anchored = true}, 100)(1, 1) / after({}, 100)(1, 1))},
                  cases.hold());
}

/// Over s_v and s_w: the eigenvalues with the gains of (3.14), and after 100 steps of the example.
Plot anchored_eigenvalue_surfaces() {
  const auto larger_first = [](const Vector2d& values) { return std::vector<double>{values[1], values[0]}; };
  const auto second = [&](double v, double w) {
    return larger_first(eigenvalues(anchored_system(v, w), closed_form_gain(v, w, false)));
  };
  const auto later = [&](double v, double w) {
    const LinearSystem s = anchored_system(v, w);
    const MatrixXd first = predicted(s, Vector2d(0, 1).asDiagonal().toDenseMatrix());
    return larger_first(eigenvalues(s, iterate_riccati(s, first, {.max_iterations = 99}).K));
  };
  const std::vector<std::string> labels{"larger", "smaller"};
  return monobot::eigenvalue_surfaces(
      "fig-3.7", "Eigenvalues of F - KHF, one landmark and an anchor",
      {{"second step, (3.14) corrected", labels, second}, {"after 100 steps", labels, later}});
}

LedgerEntry run_example_3_3(const ExperimentSettings& settings) {
  return entry_of(example_3_3, settings,
                  {full_rank(), closed_form_gains(), inside_the_circle(), inside_at_every_step(),
                   inside_in_the_limit(), forgets_the_start(settings.seeds), smaller_variances(),
                   consistent("3.3-consistent", "Figure 3.8 (b), (c)", {.anchored = true}, settings.seeds)},
                  {anchored_eigenvalue_surfaces(),
                   four_rows("fig-3.8", "With an anchor at the origin", {.anchored = true})});
}

}  // namespace

const Experiment example_3_3{"3.3", "A monobot with an anchor", {"fig-3.7", "fig-3.8"}, run_example_3_3};

}  // namespace incognita
