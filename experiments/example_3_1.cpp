// Example 3.1: the monobot without an anchor. Its error dynamics keep one eigenvalue at 1.
//
// Experiment: monobot.hpp, with 1 and 2 landmarks, 100 steps; 1000 and 10000 where limits are asked for; the
// effect of their number with 1 to 20 landmarks, 50 steps and three times as many runs.
// Measured: eigenvalues and covariances against closed forms, in which there is no chance; errors over seeds
// 1, 2, ... against the covariance of the filter.
// Holds: a closed form to 1e-9 relative, an identity to 1e-12; `goes to zero` when 100 times the steps leave less
// than a tenth; a mean, rms or slope within the margin that is said; a comparison of errors with its 95 % interval
// of paired differences on one side of 0.
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"

namespace incognita {
namespace {

using namespace monobot;

const std::vector<double> process_noises_m = {0.05, 0.1, 0.3, 0.7, 2},
                          measurement_noises_m = {0.05, 0.2, 0.5, 1.5};

/// Calls for every pair of noises with their standard deviations.
template <class Work>
void for_all_noises(Work&& work) {
  for (const double v : process_noises_m)
    for (const double w : measurement_noises_m) work(v, w);
}

LinearSystem system(double v, double w) { return monobot::system({.sigma_v_m = v, .sigma_w_m = w}); }

/// Where the Riccati equation leads from the first covariance of the example.
RiccatiLimit limit(double v, double w) {
  return iterate_riccati(system(v, w), Vector2d(0, 1).asDiagonal().toDenseMatrix());
}

struct Printed {
  Matrix2d P;
  double s2;
  Vector2d K;
};

/// (3.9), (3.10) and the gain between them.
Printed printed(double v, double w) {
  const double landmark = w * w / (1 + w * w);
  Printed p{Vector2d(v * v, landmark).asDiagonal(), v * v + w * w + landmark, {}};
  p.K = Vector2d(-v * v, landmark) / p.s2;
  return p;
}

/// The covariance after the first measurement.
MatrixXd updated_once(double v, double w) {
  const LinearSystem s = system(v, w);
  const MatrixXd P0 = Vector2d(0, 1).asDiagonal();
  return updated(s, P0, kalman_gain(s, P0));
}

Claim one_eigenvalue_is_one() {
  RandomStream random(1, "gains");
  const LinearSystem s = system(0.1, 0.2);
  double off_one = 0, off_other = 0;
  for (int i = 0; i < 1000; ++i) {
    const double k1 = random.uniform(-5, 5),
                 k2 = i % 3 == 0 ? k1 + 1e-9 * random.normal() : random.uniform(-5, 5);
    const Matrix2d A = error_dynamics(s, Vector2d(k1, k2));
    off_one = std::max(off_one, (A * Vector2d::Ones() - Vector2d::Ones()).norm());
    off_other = std::max(off_other, std::abs(A.trace() - 1 - (1 + k1 - k2)));
  }
  return assessed("3.1-eigenvalue-one", "(3.8), Example 3.1",
                  "For every gain the eigenvalues of F - KHF are 1 and k1 - k2 + 1; tested on the vector [1 "
                  "1]', which must come back unchanged, and the trace, to 1e-12",
                  {.printed = "{1, k1 - k2 + 1}",
                   .measured = {"largest differences over 1000 gains, a third of them with k1 = k2 to 1e-9, "
                                "where both eigenvalues are 1: {} and {}",
                                below(off_one), below(off_other)},
                   .runs = 1000},
                  std::max(off_one, off_other) <= 1e-12);
}

/// The covariance in the steady state: the first estimates corrected once by the information of all
/// measurements about the relative position, whose variance then is p - v^2; the robot has p more.
Matrix2d steady(double v, double w) {
  const double p = relative_variance(v, w), landmark = (p - v * v) / (1 + p - v * v);
  return Matrix2d::Constant(landmark) + Matrix2d(Vector2d(p, 0).asDiagonal());
}

Claim steady_state_covariance() {
  Worst worst;
  double of_second_step = 0;
  for_all_noises([&](double v, double w) {
    const MatrixXd P = limit(v, w).P;
    worst.take(relative_difference(printed(v, w).P, P), relative_difference(steady(v, w), P));
    of_second_step = std::max(
        of_second_step, relative_difference(printed(v, w).P, predicted(system(v, w), updated_once(v, w))));
  });
  const Matrix2d P = steady(0.1, 0.2), as_printed = printed(0.1, 0.2).P;
  return assessed(
      "3.1-steady-covariance", "(3.9), Example 3.1",
      "Solving the Riccati equation from the covariance diag(0, 1) gives this steady state, to 1e-9",
      {.printed = "P = diag(s_v^2, s_w^2/(1 + s_w^2))",
       .measured =
           {"with s_v 0.1 m, s_w 0.2 m printed diag({:.4f}, {:.4f}) m^2, limit [{:.4f} {:.4f}; {:.4f} "
            "{:.4f}] m^2. Largest relative difference from the limit over {} pairs of noises: {}",
            as_printed(0, 0), as_printed(1, 1), P(0, 0), P(0, 1), P(1, 0), P(1, 1),
            process_noises_m.size() * measurement_noises_m.size(), worst.text()},
       .number = exactly("largest relative difference of (3.9) from the limit", worst.printed),
       .why =
           {"(3.9) is the covariance after one update and one prediction (difference {}). The limit is [c+p c; "
            "c c], p = (s_v^2 + sqrt(s_v^4 + 4 s_v^2 s_w^2))/2, c = (p - s_v^2)/(1 + p - s_v^2)",
            below(of_second_step)}},
      worst.printed <= 1e-9, in_truth(worst.ours <= 1e-9 && of_second_step <= 1e-9));
}

Claim steady_state_gain() {
  Worst worst;
  double of_second_step = 0;
  for_all_noises([&](double v, double w) {
    const RiccatiLimit l = limit(v, w);
    const MatrixXd second = predicted(system(v, w), updated_once(v, w));
    of_second_step =
        std::max(of_second_step, relative_difference(printed(v, w).K, kalman_gain(system(v, w), second)));
    const double p = relative_variance(v, w),
                 s2 = (system(v, w).H * l.P * system(v, w).H.transpose())(0, 0) + w * w;
    worst.take(
        std::max(relative_difference(printed(v, w).K, l.K), std::abs(printed(v, w).s2 / s2 - 1)),
        std::max(relative_difference(Vector2d(-p / (p + w * w), 0), l.K), std::abs((p + w * w) / s2 - 1)));
  });
  const Vector2d K = printed(0.1, 0.2).K, ours = limit(0.1, 0.2).K;
  return assessed(
      "3.1-steady-gain", "(3.10) and the gain above it, Example 3.1",
      "Gain and innovation variance in the steady state, to 1e-9",
      {.printed = "K = [-s_v^2, s_w^2/(1 + s_w^2)]'/s^2, s^2 = s_v^2 + s_w^2 + s_w^2/(1 + s_w^2)",
       .measured =
           {"with s_v 0.1 m, s_w 0.2 m printed [{:.3f}, {:.3f}]', limit [{:.3f}, {:.3f}]'. Largest relative "
            "difference over all noises: {}",
            K[0], K[1], ours[0], std::abs(ours[1]), worst.text()},
       .number = exactly("largest relative difference of the printed gain from the limit", worst.printed),
       .why =
           {"what is printed is the gain of the second step (difference {}). In the limit K = [-p/(p + s_w^2), "
            "0]', s^2 = p + s_w^2: the landmark is not corrected any more",
            below(of_second_step)}},
      worst.printed <= 1e-9, in_truth(worst.ours <= 1e-9 && of_second_step <= 1e-9));
}

Claim printed_matrix() {
  Worst worst;
  for_all_noises([&](double v, double w) {
    const auto [P, s2, K] = printed(v, w);
    const double s = std::sqrt(s2), w2 = w * w, landmark = w2 / (1 + w2);
    Matrix2d as_printed, ours;
    as_printed << s2 - v * v, v * v, landmark, (s * (1 + w2) - w2) / (1 + w2);
    ours << s2 - v * v, v * v, landmark, (s2 * (1 + w2) - w2) / (1 + w2);
    const MatrixXd A = error_dynamics(system(v, w), K);
    worst.take(relative_difference(as_printed / s2, A), relative_difference(ours / s2, A));
  });
  return assessed("3.1-printed-dynamics", "(3.11), Example 3.1",
                  "F - KHF with the gain printed above it, to 1e-12",
                  {.printed = "last entry (s (1 + s_w^2) - s_w^2)/((1 + s_w^2) s^2)",
                   .measured = "largest relative difference over all noises: " + worst.text(),
                   .number = exactly("largest relative difference of (3.11) as printed", worst.printed),
                   .why = "s^2, not s: (s^2 (1 + s_w^2) - s_w^2)/((1 + s_w^2) s^2)"},
                  worst.printed <= 1e-12, as_corrected(worst.ours <= 1e-12));
}

Claim second_eigenvalue() {
  double of_printed = 0, of_second_step = 0, of_limit = 0;
  for_all_noises([&](double v, double w) {
    const auto [P, s2, K] = printed(v, w);
    const double p = relative_variance(v, w);
    const double at_second = error_dynamics(system(v, w), K).trace() - 1;
    const double at_limit = error_dynamics(system(v, w), limit(v, w).K).trace() - 1;
    of_printed = std::max(of_printed, std::abs((v * v - w * w) / s2 - at_second));
    of_second_step = std::max(of_second_step, std::abs(w * w / s2 - at_second));
    of_limit = std::max(of_limit, std::abs(w * w / (p + w * w) - at_limit));
  });
  const double s2 = printed(0.1, 0.2).s2;
  return assessed(
      "3.1-second-eigenvalue", "below (3.11), Example 3.1", "The second eigenvalue for that gain, to 1e-9",
      {.printed = "(s_v^2 - s_w^2)/s^2",
       .measured = {"with s_v 0.1 m, s_w 0.2 m printed {:.3f}, in truth {:.3f}. Largest difference over "
                    "all noises: printed {:.2g}, ours {}; in the limit {}",
                    (0.01 - 0.04) / s2, 0.04 / s2, of_printed, below(of_second_step), below(of_limit)},
       .number = exactly("largest difference of the printed eigenvalue", of_printed),
       .why = "s_w^2/s^2 for that gain; s_w^2/(p + s_w^2) in the limit"},
      of_printed <= 1e-9, as_corrected(std::max(of_second_step, of_limit) <= 1e-9));
}

Claim always_one() {
  double off_one = 0;
  Extremes other;
  for_all_noises([&](double v, double w) {
    const MatrixXd A = error_dynamics(system(v, w), limit(v, w).K);
    off_one = std::max(off_one, (A * Vector2d::Ones() - Vector2d::Ones()).norm());
    other.take(A.trace() - 1);
  });
  return assessed("3.1-marginal", "Figure 3.3, Example 3.1",
                  "Whatever the noises, one eigenvalue is 1 (to 1e-12) and the other inside the circle: the "
                  "error dynamics are marginally stable, also in the steady state",
                  {.measured = {"difference of one from 1 {}; the other is between {:.3g} and {:.3g}, over "
                                "s_v 0.05 to 2 m, s_w 0.05 to 1.5 m",
                                below(off_one), other.least, other.most}},
                  off_one <= 1e-12 && other.least > 0 && other.most < 1);
}

Claim finite_steady_error(int seeds) {
  const Setup setup{.steps = 1000};
  const auto runs = simulate_all(setup, seeds);
  const Interval after_100 = rms_of(errors(runs, 1, 100)), after_1000 = rms_of(errors(runs, 1, 1000));
  const MatrixXd P = settled_prior(setup);
  const double landmark = std::sqrt(P(1, 1)), robot = std::sqrt(P(0, 0) - setup.sigma_v_m * setup.sigma_v_m);
  const Answer as_predicted = agrees(after_1000, landmark, 0.2 * landmark) &&
                              agrees(rms_of(errors(runs, 0, 1000)), robot, 0.2 * robot);
  return assessed("3.1-finite-error", "below (3.11), Figure 3.4 (b), (c)",
                  "The errors of robot and landmark neither grow nor vanish: rms over runs after 1000 steps "
                  "as predicted by the limit covariance, to a fifth",
                  {.rule = Rule::equality,
                   .measured = {"landmark {} after 100 steps, {} after 1000, predicted {:.3f} m; robot {} "
                                "after 1000, predicted {:.3f} m",
                                text(after_100, "m"), text(after_1000, "m"), landmark,
                                text(rms_of(errors(runs, 0, 1000)), "m"), robot},
                   .number = ClaimNumber{"landmark's rms error after 1000 steps", after_1000, "m"},
                   .seeds = seeds},
                  as_predicted);
}

Claim depends_on_the_start(int seeds) {
  double lost = 0;
  for (const int n : {1, 2}) {
    const Setup as_it_is{.landmarks = n, .steps = 1000}, shifted{.landmarks = n, .steps = 1000, .shift_m = 1};
    const MatrixXd by = simulate(as_it_is, 1).error() - simulate(shifted, 1).error();
    lost = std::max(lost, (by.array() - 1).abs().maxCoeff());
  }
  // the robot's first error is 1 m rms, and the landmark is initialized from its first measurement
  const auto runs = simulate_all({.robot_var_m2 = 1, .landmark_var_m2 = {}}, seeds);
  const auto first = errors(runs, 0, 0), last = errors(runs, 1, 100);
  const Interval slope = slope_of(first, last);
  return assessed(
      "3.1-initial-conditions", "below (3.11), Example 3.1",
      "The steady-state error depends on the initial conditions: all first estimates wrong by 1 m stay wrong "
      "by 1 m (to 1e-9 over 1000 steps), and over runs the landmark's final error follows the robot's first "
      "with slope 1 to 0.05",
      {.rule = Rule::equality,
       .measured = {"of 1 m, in m, was lost {}; slope {}", below(lost), text(slope)},
       .number = ClaimNumber{"slope of the final over the first error", slope},
       .seeds = seeds},
      lost <= 1e-9 && agrees(slope, 1, 0.05));
}

Claim more_landmarks(int seeds) {
  const int runs = 3 * seeds;  // few landmarks and many differ by less than errors scatter
  std::vector<std::string> lines;
  std::vector<double> of_one, difference, variances;
  for (const int n : {1, 2, 5, 20}) {
    const Setup setup{.landmarks = n, .steps = 50};
    const auto last = errors(simulate_all(setup, runs), 1, 50);
    variances.push_back(settled_prior(setup)(1, 1));
    lines.push_back(fmt::format("{}: {}", n, text(rms_of(last), "m")));
    if (n == 1) of_one = last;
    difference = squares_less(last, of_one);
  }
  const double floor = settled_prior({.landmarks = 1000, .robot_var_m2 = 1, .landmark_var_m2 = {}})(1, 1);
  return assessed(
      "3.1-more-landmarks", "below Figure 3.3, Example 3.1",
      "The steady-state error, smaller than the initial one, is smaller the more landmarks there "
      "are: by the limit covariance, and in paired runs with 1 and 20 landmarks",
      {.rule = Rule::superiority,
       .measured = {"rms error of the first landmark by number of landmarks: {}; mean square "
                    "with 1 less that with 20: {}. But 1000 landmarks initialized by a robot that starts "
                    "with 1 m settle at {:.4f} m",
                    fmt::join(lines, "; "), text(mean_of(difference), "m^2"), std::sqrt(floor)},
       .number =
           ClaimNumber{"mean square error with 1 landmark less that with 20", mean_of(difference), "m^2"},
       .seeds = runs},
      is_above(mean_of(difference), 0) && std::is_sorted(variances.rbegin(), variances.rend()) &&
          variances[0] < 1);
}

Claim landmark_gain_vanishes() {
  double exponent = 0, of_two = 0;
  const Cases cases = by_number({1, 2}, [&](int n) -> CaseResult {
    const auto gains = course({.landmarks = n, .steps = 1000}).gain;
    const auto largest = [&](int step) { return gains[step].bottomRows(n).cwiseAbs().maxCoeff(); };
    exponent = exponent_of({10, 100, 1000}, {largest(10), largest(100), largest(1000)});
    of_two = largest(1000);
    return {{"{:.2g}, {}", largest(10),
             largest(1000) < 1e-12 ? below(largest(1000)) : fmt::format("{:.2g}", of_two)},
            vanishes(largest(10), largest(1000))};
  });
  return assessed(
      "3.1-landmark-gain", "below Figure 3.3, Figure 3.4 (d)",
      "The landmark part of the gain goes to zero (100 times the steps leave less than a tenth)",
      {.rule = Rule::superiority,
       .measured = {"after 10 and 1000 steps, by number of landmarks: {}; with two it falls as step^{:.2f}",
                    cases.text(), exponent},
       .number = exactly("gain of a landmark after 1000 steps, two landmarks", of_two)},
      cases.hold());
}

Claim landmark_variance_vanishes() {
  double of_one = 0;
  const auto variances = [&](bool anchored) {
    return by_number({1, 2}, [&](int n) -> CaseResult {
      const double early = after({.landmarks = n, .anchored = anchored}, 100)(1, 1),
                   late = after({.landmarks = n, .anchored = anchored}, 10'000)(1, 1);
      if (!anchored && n == 1) of_one = late;
      return {{"{:.2g}, {:.2g} m^2", early, late}, vanishes(early, late)};
    });
  };
  const Cases free = variances(false), anchored = variances(true);
  return assessed(
      "3.1-landmark-variance", "below Figure 3.3, Example 3.1; Section 3.5",
      "The uncertainty of stationary landmarks approaches zero (100 times the steps leave less than a "
      "tenth of the variance), in this example",
      {.rule = Rule::superiority,
       .measured = {"after 100 and 10000 steps, by number of landmarks: {}; with an anchor {}", free.text(),
                    anchored.text()},
       .number = exactly("landmark's variance after 10000 steps, one landmark", of_one, "m^2"),
       .why = "they can be observed, as with an anchor, which this example has not"},
      free.hold(), on_condition(anchored.hold()));
}

/// Over s_v and s_w: the eigenvalues in the steady state, and those of the printed gain with the printed
/// formula.
Plot eigenvalue_surfaces() {
  const auto steady = [](double v, double w) {
    return std::vector<double>{1, w * w / (relative_variance(v, w) + w * w)};
  };
  const auto second = [](double v, double w) {
    const double s2 = printed(v, w).s2;
    return std::vector<double>{1, w * w / s2, (v * v - w * w) / s2};
  };
  return monobot::eigenvalue_surfaces(
      "fig-3.3", "Eigenvalues of F - KHF, one landmark, no anchor",
      {{"steady state", {"first", "second"}, steady},
       {"gain between (3.9) and (3.10)", {"first", "second", "second, as printed"}, second}});
}

LedgerEntry run_example_3_1(const ExperimentSettings& settings) {
  return entry_of(
      example_3_1, settings,
      {one_eigenvalue_is_one(), steady_state_covariance(), steady_state_gain(), printed_matrix(),
       second_eigenvalue(), always_one(), finite_steady_error(settings.seeds),
       depends_on_the_start(settings.seeds), more_landmarks(settings.seeds), landmark_gain_vanishes(),
       landmark_variance_vanishes(), consistent("3.1-consistent", "Figure 3.4 (b), (c)", {}, settings.seeds)},
      {eigenvalue_surfaces(), four_rows("fig-3.4", "No anchor", {})});
}

}  // namespace

const Experiment example_3_1{"3.1", "A monobot without an anchor", {"fig-3.3", "fig-3.4"}, run_example_3_1};

}  // namespace incognita
