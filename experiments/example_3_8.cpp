// Example 3.8: the monobot without an anchor, only the map decorrelated before each update, with least trace.
//
// Experiment: monobot.hpp, 1 to 4 landmarks, up to 600 steps.
// Measured: covariances and gains, which do not depend on chance; the landmark's errors over seeds 1, 2, ...
// Holds: bounded when the trace grows by less than 1 % of the process noise a step between steps 300 and 600;
// ranks by singular values above 1e-6 of the largest; a gain settles when 300 steps change it by less than
// 1e-6.
#include "experiments/common.hpp"
#include "experiments/monobot.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using monobot::Course;
using monobot::Decorrelated;
using monobot::Setup;

Setup decorrelated(int landmarks, Decorrelated what = Decorrelated::map, int steps = 600) {
  return {.landmarks = landmarks, .decorrelated = what, .steps = steps};
}

/// Of the trace, a step, between steps 300 and 600; as a share of the process noise.
double growth(const Setup& setup, const std::vector<MatrixXd>& P) {
  return (P[600].trace() - P[300].trace()) / 300 / (setup.sigma_v_m * setup.sigma_v_m);
}

constexpr double least_growth = 0.01;

Claim bounded() {
  const Cases cases = by_number({1, 2, 3, 4}, [](int n) -> CaseResult {
    const auto P = monobot::course(decorrelated(n)).posterior;
    const double g = growth(decorrelated(n), P);
    return {
        fmt::format("robot {:.4f} m^2, landmark {:.4f} m^2, growth {}", P[600](0, 0), P[600](1, 1), below(g)),
        std::abs(g) < least_growth};
  });
  return assessed(
      "3.8-bounded", "Example 3.8, Figure 3.15, Section 3.5",
      "With only the map decorrelated the covariance converges",
      {.printed = "bounded",
       .measured =
           "by number of landmarks, variances after 600 steps and growth as a share of the process noise: " +
           cases.text()},
      cases.hold());
}

Claim one_landmark_is_as_before() {
  const Course plain = monobot::course({.landmarks = 1, .steps = 600}),
               dropped = monobot::course(decorrelated(1));
  double off = 0;
  for (std::size_t k = 1; k < plain.gain.size(); ++k)
    off = std::max(
        {off, (plain.gain[k] - dropped.gain[k]).norm(), (plain.posterior[k] - dropped.posterior[k]).norm()});
  return assessed(
      "3.8-one-landmark", "Example 3.8",
      "With one landmark this is Example 3.1: the same gains and covariances",
      {.printed = "identical", .measured = fmt::format("largest difference over 600 steps: {}", off)},
      off == 0);
}

Claim landmark_variance_is_greater() {
  const Course plain = monobot::course({.landmarks = 2, .steps = 600}),
               dropped = monobot::course(decorrelated(2));
  bool greater = true;
  for (std::size_t k = 2; k < plain.posterior.size();
       ++k)  // before the first update there is nothing to drop
    greater = greater && dropped.posterior[k](1, 1) > plain.posterior[k](1, 1);
  return assessed(
      "3.8-variance", "Example 3.8",
      "With two landmarks their variance is greater than without decorrelation, at every step from the "
      "second on",
      {.printed = "greater",
       .measured = fmt::format("after 100 steps {:.4f} against {:.4f} m^2; the robot's is the same, {:.4f} "
                               "against {:.4f} m^2, because nothing is added to the mean of equal landmarks",
                               dropped.posterior[100](1, 1), plain.posterior[100](1, 1),
                               dropped.posterior[100](0, 0), plain.posterior[100](0, 0))},
      greater);
}

Claim landmark_gain_settles() {
  const auto gain = monobot::course(decorrelated(2)).gain;
  const double last = gain[600](1, 0), change = std::abs(last - gain[300](1, 0));
  const double of_mean = (gain[600].row(1) + gain[600].row(2)).cwiseAbs().maxCoeff();
  return assessed("3.8-gain", "Example 3.8, Figure 3.15 (d)",
                  "With two landmarks their gains do not become zero; they converge to a steady state",
                  {.printed = "not 0",
                   .measured = fmt::format("landmark 1 by its own measurement: {:.4f}; change in 300 steps "
                                           "{}. The gain of the landmarks' mean still goes to zero: {}",
                                           last, below(change), below(of_mean))},
                  last > 1e-3 && change < 1e-6);
}

Claim controllable() {
  const Cases cases = by_number({2, 3, 4}, [](int n) -> CaseResult {
    const Setup setup = decorrelated(n, Decorrelated::map, 100);
    const int rank = monobot::excited(setup, monobot::course(setup).inflation[100]).rank;
    return {fmt::format("{} of {}", rank, n + 1), rank == n + 1};
  });
  return assessed("3.8-controllable", "Example 3.8, Section 3.3",
                  "Decorrelating the map makes the system controllable",
                  {.printed = "rank n + 1",
                   .measured = "rank of [G Q^1/2, dP^1/2] by number of landmarks n: " + cases.text(),
                   .why = "the dP of least trace has rank n - 1: it reaches the differences between "
                          "landmarks and leaves their mean alone. That is why the filter stays bounded; were "
                          "the mean reached too, all would drift together (see the pseudo-noise of (3.29))"},
                  cases.hold());
}

/// A case of (3.29): what is added, and whether the covariance then stays bounded.
struct Case {
  std::string name;
  int rank, with_noise, observable;
  bool bounded;
};

Case inflated_case(int n, Decorrelated what) {
  const Setup setup = decorrelated(n, what);
  const Course course = monobot::course(setup);
  const MatrixXd dP = course.inflation[600];
  return {fmt::format("{} with {}", what == Decorrelated::map ? "map" : "everything", n),
          rank_of(dP, 1e-6).rank, monobot::excited(setup, dP).rank,
          rank_of(observability_matrix(monobot::system(setup))).rank,
          growth(setup, course.posterior) < least_growth};
}

/// The same noise of 0.05 m a step on every landmark, and on the robot too if asked.
Case constant_case(int n, bool robot_too) {
  const Setup setup{.landmarks = n};
  MatrixXd dP = 0.05 * 0.05 * MatrixXd::Identity(n + 1, n + 1);
  if (!robot_too) dP(0, 0) = 0;
  const LinearSystem noisy = monobot::with_pseudo_noise(monobot::system(setup), dP);
  std::vector<MatrixXd> P{monobot::first_covariance(setup)};
  for (int k = 0; k < 600; ++k) {
    const MatrixXd prior = predicted(noisy, P.back());
    P.push_back(updated(noisy, prior, kalman_gain(noisy, prior)));
  }
  return {fmt::format("constant{} with {}", robot_too ? " on all" : "", n), rank_of(dP, 1e-6).rank,
          monobot::excited(setup, dP).rank, rank_of(observability_matrix(noisy)).rank,
          growth(setup, P) < least_growth};
}

std::vector<Claim> rank_condition() {
  std::vector<Case> tried;
  for (const int n : {1, 2, 3, 4}) {
    tried.push_back(inflated_case(n, Decorrelated::map));
    tried.push_back(inflated_case(n, Decorrelated::everything));
    tried.push_back(constant_case(n, false));
    tried.push_back(constant_case(n, true));
  }
  Cases only_when;
  bool when = true, with_noise = true;
  for (const Case& c : tried) {
    when = when && (c.bounded || c.rank > c.observable);
    with_noise = with_noise && c.bounded == (c.with_noise <= c.observable);
    only_when.add({fmt::format("{}: {}, {}, {} {}", c.name, c.rank, c.with_noise, c.observable,
                               c.bounded ? "bounded" : "unbounded"),
                   !c.bounded || c.rank <= c.observable});
  }
  return {
      assessed("3.8-rank-condition", "(3.29)",
               "Partially observable SLAM with an inflated covariance converges only when rank dP <= rank O; "
               "tested with the map decorrelated, everything decorrelated, and a constant noise on all "
               "landmarks, with and without the robot, 1 to 4 of them",
               {.printed = "rank dP <= rank O",
                .measured = "rank dP, rank [G Q^1/2, dP^1/2], rank O: " + only_when.text()},
               only_when.hold()),
      assessed(
          "3.8-rank-enough", "(3.29), as it is used in Section 3.3",
          "The rank of dP decides whether the covariance stays bounded: rank dP <= rank O is enough as well",
          {.printed = "rank dP <= rank O",
           .measured = "the cases above",
           .why = "rank dP <= rank O also where the covariance grows without bound. What separates the cases "
                  "is rank [G Q^1/2, dP^1/2] <= rank O: the process noise counts"},
          when, with_noise)};
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(
      example_3_8, settings,
      concatenated(
          {{bounded(), one_landmark_is_as_before(), landmark_variance_is_greater(), landmark_gain_settles(),
            controllable(),
            monobot::inflated("3.8-inflated", decorrelated(2, Decorrelated::map, 100), settings.seeds)},
           rank_condition()}),
      {monobot::four_rows("fig-3.15", "No anchor, map decorrelated", {.decorrelated = Decorrelated::map})});
}

}  // namespace

const Experiment example_3_8{"3.8", "A monobot without an anchor, its map decorrelated", {"fig-3.15"}, run};

}  // namespace incognita
