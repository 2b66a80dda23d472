// Example 3.10: the monobot with an anchor, everything or only the map decorrelated, with least trace.
//
// Experiment: monobot.hpp with the anchor, 1 and 2 landmarks, 100 to 1000 steps.
// Measured: covariances and gains, which do not depend on chance; the landmark's errors over seeds 1, 2, ...
// Holds: settled when 500 more steps change nothing by more than 1e-6 relative; a gain goes to zero when 100
// times the steps leave less than a tenth of it; errors as in Example 3.1.
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"

namespace incognita {
namespace {

using namespace monobot;

Setup decorrelated(int landmarks, Decorrelated what, int steps = 1000, bool anchored = true) {
  return {.landmarks = landmarks, .anchored = anchored, .decorrelated = what, .steps = steps};
}

Claim stable() {
  double largest_of_all = 0;
  const Cases cases = by_number({1, 2}, [&](int n) -> CaseResult {
    const Setup setup = decorrelated(n, Decorrelated::everything);
    const Course course = monobot::course(setup);
    const MatrixXd& P = course.posterior[1000];
    const double change = relative_difference(course.posterior[500], P);
    const double largest = eigenvalues(error_dynamics(system(setup), course.gain[1000])).maxCoeff();
    largest_of_all = std::max(largest_of_all, largest);
    return {{"robot {:.5f}, landmark {:.5f} m^2, change {}, eigenvalue {:.3f}", P(0, 0), P(1, 1),
             below(change), largest},
            change < 1e-6 && largest < 0.999};
  });
  return assessed(
      "3.10-stable", "Figure 3.18, Section 3.4",
      "With an anchor everything can be decorrelated and the filter stays stable: the covariance settles, "
      "and all eigenvalues of F - KHF are inside the circle (below 0.999)",
      {.rule = Rule::equality,
       .measured = "by number of landmarks, after 1000 steps, change from step 500 on, largest eigenvalue: " +
                   cases.text(),
       .number = exactly("largest eigenvalue", largest_of_all)},
      cases.hold());
}

/// Largest landmark gain by the landmark's own measurement after the given number of steps.
double landmark_gain(const Course& course, int step) {
  const MatrixXd& K = course.gain[step];
  return K.bottomRightCorner(K.rows() - 1, K.rows() - 1).diagonal().maxCoeff();
}

/// After 10 and 1000 steps, of one landmark and of two, and that they do not go to zero.
Cases gains_that_stay(Decorrelated what) {
  return by_number({1, 2}, [&](int n) -> CaseResult {
    const Course course = monobot::course(decorrelated(n, what));
    const double at_10 = landmark_gain(course, 10), at_1000 = landmark_gain(course, 1000);
    return {{"{:.4f}, {:.4f}", at_10, at_1000}, !vanishes(at_10, at_1000)};
  });
}

double last_gain_of_one(Decorrelated what) { return landmark_gain(course(decorrelated(1, what)), 1000); }

Claim gain_with_everything_decorrelated() {
  const Cases cases = gains_that_stay(Decorrelated::everything);
  return assessed(
      "3.10-gain-everything", "Example 3.10, Figure 3.18 (d)",
      "With an anchor and everything decorrelated the landmarks' gains do not go to zero (100 times the "
      "steps leave more than a tenth)",
      {.rule = Rule::superiority,
       .measured = "by number of landmarks, after 10 and 1000 steps: " + cases.text(),
       .number = exactly("landmark's gain after 1000 steps, one landmark",
                         last_gain_of_one(Decorrelated::everything))},
      cases.hold());
}

/// With one landmark nothing is added; with two nothing to their mean, whose variance goes to zero as their gains
/// do.
bool mean_is_not_reached() {
  const Course one = course(decorrelated(1, Decorrelated::map)),
               two = course(decorrelated(2, Decorrelated::map));
  bool reached = false;
  for (std::size_t k = 1; k < two.inflation.size(); ++k)
    reached = reached || one.inflation[k].norm() > rounding_error ||
              two.inflation[k].bottomRightCorner<2, 2>().sum() > rounding_error;
  const auto of_mean = [&](int step) { return two.posterior[step].bottomRightCorner<2, 2>().sum() / 4; };
  return !reached && vanishes(of_mean(10), of_mean(1000)) &&
         vanishes(landmark_gain(one, 10), landmark_gain(one, 1000)) &&
         vanishes(landmark_gain(two, 10), landmark_gain(two, 1000));
}

Claim gain_with_the_map_decorrelated() {
  const Cases cases = gains_that_stay(Decorrelated::map);
  return assessed(
      "3.10-gain-map", "Example 3.10",
      "With an anchor and the map decorrelated the landmarks' gains do not go to zero (100 times the "
      "steps leave more than a tenth)",
      {.rule = Rule::superiority,
       .measured = "by number of landmarks, after 10 and 1000 steps: " + cases.text(),
       .number =
           exactly("landmark's gain after 1000 steps, one landmark", last_gain_of_one(Decorrelated::map)),
       .why = "with one landmark there is nothing to decorrelate, and with two the dP of least trace adds "
              "nothing to their mean: its variance goes to zero, and with it every gain of the landmarks"},
      cases.hold(), in_truth(mean_is_not_reached()));
}

Claim independent_of_the_start() {
  double of_anchored = 0, of_free = 1e300;
  const auto last = [](Setup setup, double robot_var, double landmark_var) {
    setup.robot_var_m2 = robot_var;
    setup.landmark_var_m2 = landmark_var;
    return MatrixXd(course(setup).posterior.back());
  };
  const auto spread = [&](const Setup& setup) {
    const MatrixXd P = last(setup, 0, 1);
    return std::max((last(setup, 1, 1) - P).norm(), (last(setup, 100, 0.01) - P).norm()) / P.norm();
  };
  for (const int n : {1, 2}) {
    of_anchored = std::max(of_anchored, spread(decorrelated(n, Decorrelated::everything, 600)));
    of_free = std::min(of_free, spread({.landmarks = n, .steps = 600}));
  }
  return assessed(
      "3.10-start", "Example 3.10",
      "The solution of the Riccati equation no longer depends on the initial covariance: from three of them "
      "(robot 0, 1, 100 m^2, landmark 1, 1, 0.01 m^2) it settles at the same value, to 1e-6",
      {.measured = {"largest relative difference after 600 steps: {} (Example 3.1: {:.2g})",
                    below(of_anchored), of_free}},
      of_anchored < 1e-6);
}

Claim lower_than_without_anchor() {
  Cases cases;
  double largest_ratio = 0;
  for (const auto what : {Decorrelated::map, Decorrelated::everything})
    for (const int n : {1, 2}) {
      const auto anchored = course(decorrelated(n, what, 100)).posterior,
                 free = course(decorrelated(n, what, 100, false)).posterior;
      const Vector2d ratios =
          anchored[100].diagonal().head<2>().cwiseQuotient(free[100].diagonal().head<2>());
      largest_ratio = std::max(largest_ratio, ratios.maxCoeff());
      cases.add({{"{} with {}: robot {:.2f}, landmark {:.2f} times", name(what), n, ratios[0], ratios[1]},
                 smaller_variances(anchored, free)});
    }
  return assessed(
      "3.10-variance", "Example 3.10",
      "Variances reach lower values than in the partially observable case, at every step",
      {.rule = Rule::superiority,
       .measured = "after 100 steps: " + cases.text(),
       .number = exactly("largest variance over that without an anchor, after 100 steps", largest_ratio)},
      cases.hold());
}

Claim map_alone_is_better(int seeds) {
  const Cases traces = by_number({1, 2}, [](int n) -> CaseResult {
    const double map = course(decorrelated(n, Decorrelated::map, 100)).posterior[100].trace(),
                 all = course(decorrelated(n, Decorrelated::everything, 100)).posterior[100].trace();
    return {{"{:.4f} against {:.4f} m^2", map, all}, map < all};
  });
  const auto last = [&](Decorrelated what) {
    return errors(simulate_all(decorrelated(1, what, 100), seeds), 1, 100);
  };
  const auto map = last(Decorrelated::map), all = last(Decorrelated::everything);
  const std::vector<double> gain = squares_less(map, all);
  return assessed(
      "3.10-map-alone", "below Figure 3.18, Section 3.4",
      "Also with full observability it is best to decorrelate only the map: smaller trace after "
      "100 steps, and smaller errors of the landmark in paired runs (one landmark)",
      {.rule = Rule::superiority,
       .measured = {"trace by number of landmarks, map alone against everything: {}; rms error "
                    "{} against {}; mean square less: {}",
                    traces.text(), text(rms_of(map), "m"), text(rms_of(all), "m"),
                    text(mean_of(gain), "m^2")},
       .number = ClaimNumber{"landmark's mean square error less with the map alone", mean_of(gain), "m^2"},
       .seeds = seeds},
      traces.hold() && is_above(mean_of(gain), 0));
}

Claim pseudo_noise_on_everything() {
  const Cases cases = by_number({1, 2}, [](int n) -> CaseResult {
    const Setup setup{.landmarks = n, .anchored = true};
    const LinearSystem noisy = with_constant_noise(setup, true);
    const RiccatiLimit limit = iterate_riccati(noisy, predicted(noisy, start_of(setup)));
    return {{"{}, landmark {:.5f} m^2 before the update, gain {:.4f}", limit.reason, limit.P(1, 1),
             limit.K(1, 1)},
            limit.settled && limit.K(1, 1) > 1e-3};
  });
  return assessed("3.10-pseudo-noise", "Section 3.4",
                  "Fully observable, pseudo-noise on robot and landmarks (0.05 m a step) leaves a steady "
                  "state with gains that are not zero",
                  {.rule = Rule::example, .measured = "by number of landmarks: " + cases.text()},
                  cases.hold());
}

LedgerEntry run_example_3_10(const ExperimentSettings& settings) {
  return entry_of(
      example_3_10, settings,
      {stable(), gain_with_everything_decorrelated(), gain_with_the_map_decorrelated(),
       independent_of_the_start(), lower_than_without_anchor(), map_alone_is_better(settings.seeds),
       inflated("3.10-inflated", decorrelated(1, Decorrelated::everything, 100), settings.seeds),
       pseudo_noise_on_everything()},
      {four_rows("fig-3.18", "With an anchor, everything decorrelated",
                 decorrelated(1, Decorrelated::everything, 100))});
}

}  // namespace

const Experiment example_3_10{
    "3.10", "A monobot with an anchor, decorrelated", {"fig-3.18"}, run_example_3_10};

}  // namespace incognita
