// Examples 3.6 and 3.8: the monobot without an anchor, everything (3.6) or only the map (3.8) decorrelated
// before each update, with least trace.
//
// Experiment: monobot.hpp; in 3.6 10000 steps with 1 landmark, 3000 with 2; in 3.8 1 to 4 landmarks, up to
// 600 steps. Measured: covariances and gains, which do not depend on chance; the landmark's errors over seeds
// 1, 2, ...
// Holds: unbounded when the variances grow at least as step^0.9 from step 100 on; bounded when the trace
// grows by less than 1 % of the process noise a step between steps 300 and 600; a gain settles when 300 steps
// change it by less than 1e-6; ranks by singular values above 1e-6 of the largest; equalities to 1e-12
// relative.
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"

namespace incognita {
namespace {

using namespace monobot;

Setup all_decorrelated(int landmarks, int steps) {
  return {.landmarks = landmarks, .decorrelated = Decorrelated::everything, .steps = steps};
}

Setup map_decorrelated(int landmarks, int steps = 600) {
  return {.landmarks = landmarks, .decorrelated = Decorrelated::map, .steps = steps};
}

// Example 3.6: everything -----------------------------------------------------------------------------

Claim unbounded() {
  Cases cases;
  for (const auto& [n, last] : {std::pair(1, 10'000), std::pair(2, 3000)}) {
    const auto P = course(all_decorrelated(n, last)).posterior;
    for (const int state : {0, 1}) {
      std::vector<double> k, variance;
      for (const int step : {100, 300, 1000, last})
        k.push_back(step), variance.push_back(P[step](state, state));
      const double exponent = exponent_of(k, variance);
      cases.add({{"{} with {}: {:.3g} m^2 after 100, {:.3g} m^2 after {}, as step^{:.2f}",
                  state == 0 ? "robot" : "landmark", n, variance.front(), variance.back(), last, exponent},
                 exponent >= 0.9});
    }
  }
  return assessed("3.6-unbounded", "Example 3.6, Figure 3.12",
                  "Both the robot's and the landmarks' variances become unbounded",
                  {.printed = "unbounded", .measured = cases.text()}, cases.hold());
}

/// What a step adds to each variance before the update, in the long run.
Claim how_fast() {
  const Cases cases = by_number({1, 2, 4}, [](int n) -> CaseResult {
    const Setup setup = all_decorrelated(n, 600);
    const auto P = course(setup).prior;
    const double rate = (P[600].trace() - P[500].trace()) / 100 / (n + 1);
    const double predicted = setup.sigma_v_m * setup.sigma_v_m / (n + 1);
    return {{"{:.3g}, predicted {:.3g}", rate, predicted}, std::abs(rate / predicted - 1) < 0.05};
  });
  return assessed("3.6-rate", "Example 3.6",
                  "Growth is linear in time, by s_v^2/(n + 1) a step for each state: no measurement reduces "
                  "what the process noise adds to the sum of all states; tested to 5 % after 500 steps",
                  {.measured = "m^2 a step, by number of landmarks n: " + cases.text()}, cases.hold());
}

Claim full_rank_inflation() {
  bool controllable = true;
  const Cases cases = by_number({1, 2, 4}, [&](int n) -> CaseResult {
    const Setup setup = all_decorrelated(n, 100);
    const MatrixXd dP = course(setup).inflation[100];
    const int rank = rank_of(dP, 1e-6).rank, with_noise = excited(setup, dP).rank;
    controllable = controllable && with_noise == n + 1;
    return {{"{} of {}, with the process noise {}", rank, n + 1, with_noise}, rank == n + 1};
  });
  return assessed(
      "3.6-full-rank", "Example 3.6",
      "The inflation that decorrelates everything has full rank, more than can be observed, and makes the "
      "system controllable",
      {.printed = "rank n + 1",
       .measured = "rank of dP by number of landmarks n: " + cases.text(),
       .why = "the least trace is reached with rank n, which is no more than can be observed. It is dP and "
              "process noise together that reach every state: [G Q^1/2, dP^1/2] has rank n + 1"},
      cases.hold() && controllable, controllable);
}

Claim inflation_is_noise() {
  const Setup setup = all_decorrelated(1, 100);
  const LinearSystem s = system(setup);
  const auto course = monobot::course(setup);
  const MatrixXd dP = course.inflation[100];
  const LinearSystem noisy = with_pseudo_noise(s, dP);
  const MatrixXd ours = predicted(noisy, course.posterior[99]);
  const double off = relative_difference(ours, course.prior[100]);
  const auto rows = s.Q.rows() + dP.rows(), columns = dP.cols(), needed = noisy.G.cols();  // of [Q; dP]
  return assessed("3.6-as-noise", "(3.26), (3.27)",
                  "Adding dP is the same as a process noise that enters by G' = [G I], to 1e-12",
                  {.printed = "F P F' + G' [Q; dP] G''",
                   .measured = {"[Q; dP] is {}x{} where {}x{} is needed; with [Q 0; 0 dP] the relative "
                                "difference from the engine's inflated covariance is {}",
                                rows, columns, needed, needed, below(off)},
                   .why = "the noises belong on the diagonal, [Q 0; 0 dP]"},
                  columns == needed && rows == needed, off <= 1e-12);
}

// Example 3.8: the map alone --------------------------------------------------------------------------

/// Of the trace, a step, between steps 300 and 600; as a share of the process noise.
double growth(const Setup& setup, const MatrixXd& at_300, const MatrixXd& at_600) {
  return (at_600.trace() - at_300.trace()) / 300 / (setup.sigma_v_m * setup.sigma_v_m);
}

constexpr double least_growth = 0.01;

Claim bounded() {
  const Cases cases = by_number({1, 2, 3, 4}, [](int n) -> CaseResult {
    const auto P = course(map_decorrelated(n)).posterior;
    const double g = growth(map_decorrelated(n), P[300], P[600]);
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
  const Course plain = course({.landmarks = 1, .steps = 600}), dropped = course(map_decorrelated(1));
  double off = 0;
  for (std::size_t k = 1; k < plain.gain.size(); ++k)
    off = std::max(
        {off, (plain.gain[k] - dropped.gain[k]).norm(), (plain.posterior[k] - dropped.posterior[k]).norm()});
  return assessed("3.8-one-landmark", "Example 3.8",
                  "With one landmark this is Example 3.1: the same gains and covariances",
                  {.printed = "identical", .measured = {"largest difference over 600 steps: {}", off}},
                  off == 0);
}

Claim landmark_variance_is_greater() {
  const Course plain = course({.landmarks = 2, .steps = 600}), dropped = course(map_decorrelated(2));
  bool greater = true;
  for (std::size_t k = 2; k < plain.posterior.size();
       ++k)  // before the first update there is nothing to drop
    greater = greater && dropped.posterior[k](1, 1) > plain.posterior[k](1, 1);
  return assessed("3.8-variance", "Example 3.8",
                  "With two landmarks their variance is greater than without decorrelation, at every step "
                  "from the second on",
                  {.printed = "greater",
                   .measured = {"after 100 steps {:.4f} against {:.4f} m^2; the robot's is the same, {:.4f} "
                                "against {:.4f} m^2, because nothing is added to the mean of equal landmarks",
                                dropped.posterior[100](1, 1), plain.posterior[100](1, 1),
                                dropped.posterior[100](0, 0), plain.posterior[100](0, 0)}},
                  greater);
}

Claim landmark_gain_settles() {
  const auto gain = course(map_decorrelated(2)).gain;
  const double last = gain[600](1, 0), change = std::abs(last - gain[300](1, 0));
  const double of_mean = (gain[600].row(1) + gain[600].row(2)).cwiseAbs().maxCoeff();
  return assessed("3.8-gain", "Example 3.8, Figure 3.15 (d)",
                  "With two landmarks their gains do not become zero; they converge to a steady state",
                  {.printed = "not 0",
                   .measured = {"landmark 1 by its own measurement: {:.4f}; change in 300 steps {}. The gain "
                                "of the landmarks' mean still goes to zero: {}",
                                last, below(change), below(of_mean)}},
                  last > 1e-3 && change < 1e-6);
}

Claim map_makes_controllable() {
  const Cases cases = by_number({2, 3, 4}, [](int n) -> CaseResult {
    const Setup setup = map_decorrelated(n, 100);
    const int rank = excited(setup, course(setup).inflation[100]).rank;
    return {{"{} of {}", rank, n + 1}, rank == n + 1};
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

Case case_of(const std::string& name, const Setup& setup, const MatrixXd& dP, double growth) {
  return {fmt::format("{} with {}", name, setup.landmarks), rank_of(dP, 1e-6).rank, excited(setup, dP).rank,
          rank_of(observability_matrix(system(setup))).rank, growth < least_growth};
}

Case inflated_case(int n, Decorrelated what) {
  const Setup setup{.landmarks = n, .decorrelated = what, .steps = 600};
  const Course course = monobot::course(setup);
  return case_of(name(what), setup, course.inflation[600],
                 growth(setup, course.posterior[300], course.posterior[600]));
}

/// The same noise of 0.05 m a step on every landmark, and on the robot too if asked.
Case constant_case(int n, bool robot_too) {
  const Setup setup{.landmarks = n};
  const LinearSystem noisy = with_constant_noise(setup, robot_too);
  const MatrixXd at_300 = filtered(noisy, start_of(setup), 300), at_600 = filtered(noisy, at_300, 300);
  return case_of(robot_too ? "constant on all" : "constant", setup, constant_noise(setup, robot_too),
                 growth(setup, at_300, at_600));
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
    only_when.add({{"{}: {}, {}, {} {}", c.name, c.rank, c.with_noise, c.observable,
                    c.bounded ? "bounded" : "unbounded"},
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

LedgerEntry run_3_6(const ExperimentSettings& settings) {
  return entry_of(example_3_6, settings,
                  {unbounded(), how_fast(), full_rank_inflation(), inflation_is_noise(),
                   inflated("3.6-inflated", all_decorrelated(1, 100), settings.seeds)},
                  {four_rows("fig-3.12", "No anchor, everything decorrelated", all_decorrelated(1, 100))});
}

LedgerEntry run_3_8(const ExperimentSettings& settings) {
  return entry_of(example_3_8, settings,
                  {bounded(), one_landmark_is_as_before(), landmark_variance_is_greater(),
                   landmark_gain_settles(), map_makes_controllable(),
                   inflated("3.8-inflated", map_decorrelated(2, 100), settings.seeds), rank_condition()},
                  {four_rows("fig-3.15", "No anchor, map decorrelated", map_decorrelated(1, 100))});
}

}  // namespace

const Experiment example_3_6{
    "3.6", "A monobot without an anchor, everything decorrelated", {"fig-3.12"}, run_3_6};
const Experiment example_3_8{
    "3.8", "A monobot without an anchor, its map decorrelated", {"fig-3.15"}, run_3_8};

}  // namespace incognita
