// Examples 3.6 and 3.8: the monobot without an anchor, everything (3.6) or only the map (3.8) decorrelated
// before each update, with least trace.
//
// Experiment: monobot.hpp; in 3.6 10000 steps with 1 landmark, 3000 with 2; in 3.8 1 to 4 landmarks, up to
// 600 steps. Measured: covariances and gains, which do not depend on chance; the landmark's errors over seeds
// 1, 2, ...
// Holds: bounded when a variance or the trace grows by less than 5 % in the second half of the steps, unbounded
// when it grows by more; a gain settles when 300 steps change it by less than 1e-6; ranks by singular values above
// 1e-6 of the largest; equalities to 1e-12 relative.
#include "experiments/boundedness.hpp"
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
  double least_growth = 1e300;
  for (const auto& [n, last] : {std::pair(1, 10'000), std::pair(2, 3000)}) {
    const auto P = course(all_decorrelated(n, last)).posterior;
    for (const int state : {0, 1}) {
      const double growth = growth_between(P[last / 2](state, state), P[last](state, state));
      least_growth = std::min(least_growth, growth);
      cases.add({{"{} with {}: {:.3g} m^2 after 100, {:.3g} m^2 after {} steps",
                  state == 0 ? "robot" : "landmark", n, P[100](state, state), P[last](state, state), last},
                 !is_bounded(growth)});
    }
  }
  return assessed(
      "3.6-unbounded", "Example 3.6, Figure 3.12",
      "Both the robot's and the landmarks' variances become unbounded: they grow by more than 5 % in the "
      "second half of the steps",
      {.rule = Rule::boundedness,
       .measured = cases.text(),
       .number = exactly("least growth in the second half of the steps", 100 * least_growth, "%")},
      cases.hold());
}

/// What a step adds to each variance before the update, in the long run.
Claim how_fast() {
  double of_one = 0;
  const Cases cases = by_number({1, 2, 4}, [&](int n) -> CaseResult {
    const Setup setup = all_decorrelated(n, 600);
    const auto P = course(setup).prior;
    const double rate = (P[600].trace() - P[500].trace()) / 100 / (n + 1);
    const double predicted = setup.sigma_v_m * setup.sigma_v_m / (n + 1);
    if (n == 1) of_one = rate;
    return {{"{:.3g}, predicted {:.3g}", rate, predicted}, std::abs(rate / predicted - 1) < 0.05};
  });
  return assessed(
      "3.6-rate", "Example 3.6",
      "Growth is linear in time, by s_v^2/(n + 1) a step for each state, to 5 % from step 500 to 600: no "
      "measurement reduces what the process noise adds to the sum of all states",
      {.rule = Rule::equality,
       .measured = "m^2 a step, by number of landmarks n: " + cases.text(),
       .number = exactly("growth a step, one landmark", of_one, "m^2")},
      cases.hold());
}

Claim full_rank_inflation() {
  bool one_less = true, controllable = true;
  int of_two = 0;
  const Cases full = by_number({1, 2, 4}, [&](int n) -> CaseResult {
    const Setup setup = all_decorrelated(n, 100);
    const MatrixXd dP = course(setup).inflation[100];
    const int rank = rank_of(dP, 1e-6).rank, with_noise = excited(setup, dP).rank;
    one_less = one_less && rank == n;
    if (n == 2) of_two = rank;
    controllable = controllable && with_noise == n + 1;
    return {{"{} of {}, with the process noise {}", rank, n + 1, with_noise}, rank == n + 1};
  });
  return assessed(
      "3.6-full-rank", "Example 3.6",
      "The inflation dP of least trace that decorrelates everything has full rank: n + 1 with n landmarks, more "
      "than can be observed",
      {.rule = Rule::dimension,
       .measured = "rank of dP by number of landmarks n: " + full.text(),
       .number = exactly("rank of dP with two landmarks, of 3", of_two),
       .why =
           "it has rank n, which is no more than can be observed. It is dP and process noise together that reach "
           "every state and make the system controllable: [G Q^1/2, dP^1/2] has rank n + 1"},
      full.hold(), in_truth(one_less && controllable));
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
                  {.printed = "G' [Q; dP] G'^T in (3.27)",
                   .measured = {"[Q; dP] is {}x{} where {}x{} is needed; with [Q 0; 0 dP] the relative "
                                "difference from the engine's inflated covariance is {}",
                                rows, columns, needed, needed, below(off)},
                   .why = "G' [Q 0; 0 dP] G'^T: the noises belong on the diagonal"},
                  columns == needed && rows == needed, as_corrected(off <= 1e-12));
}

// Example 3.8: the map alone --------------------------------------------------------------------------

Claim bounded() {
  double most = 0;
  const Cases cases = by_number({1, 2, 3, 4}, [&](int n) -> CaseResult {
    const auto P = course(map_decorrelated(n)).posterior;
    const double growth = growth_between(P[300].trace(), P[600].trace());
    most = std::max(most, growth);
    return {{"robot {:.4f}, landmark {:.4f} m^2", P[600](0, 0), P[600](1, 1)}, is_bounded(growth)};
  });
  return assessed(
      "3.8-bounded", "Example 3.8, Figure 3.15, Section 3.5",
      "With only the map decorrelated the covariance converges: its trace grows by less than 5 % in the second half "
      "of 600 steps",
      {.rule = Rule::boundedness,
       .measured = {"variances after 600 steps by number of landmarks: {}; largest growth of the trace {}",
                    cases.text(), below(most)}},
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
                  {.measured = {"largest difference over 600 steps: {}", off}}, off == 0);
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
                  {.rule = Rule::superiority,
                   .measured = {"after 100 steps {:.4f} against {:.4f} m^2; the robot's is the same, {:.4f} "
                                "against {:.4f} m^2, because nothing is added to the mean of equal landmarks",
                                dropped.posterior[100](1, 1), plain.posterior[100](1, 1),
                                dropped.posterior[100](0, 0), plain.posterior[100](0, 0)},
                   .number = exactly("landmark's variance after 100 steps over that without decorrelation",
                                     dropped.posterior[100](1, 1) / plain.posterior[100](1, 1))},
                  greater);
}

Claim landmark_gain_settles() {
  const auto gain = course(map_decorrelated(2)).gain;
  const double last = gain[600](1, 0), change = std::abs(last - gain[300](1, 0));
  const double of_mean = (gain[600].row(1) + gain[600].row(2)).cwiseAbs().maxCoeff();
  return assessed(
      "3.8-gain", "Example 3.8, Figure 3.15 (d)",
      "With two landmarks their gains do not become zero (above 1e-3); they converge to a steady state (300 "
      "steps change them by less than 1e-6)",
      {.rule = Rule::superiority,
       .measured = {"landmark 1 by its own measurement: {:.4f}; change in 300 steps {}. The gain "
                    "of the landmarks' mean still goes to zero: {}",
                    last, below(change), below(of_mean)},
       .number = exactly("landmark's gain by its own measurement after 600 steps", last)},
      last > 1e-3 && change < 1e-6);
}

Claim map_makes_controllable() {
  bool mean_alone_is_left = true;
  int of_two = 0;
  const Cases cases = by_number({2, 3, 4}, [&](int n) -> CaseResult {
    const Setup setup = map_decorrelated(n, 100);
    const MatrixXd dP = course(setup).inflation[100];
    const int rank = excited(setup, dP).rank;
    if (n == 2) of_two = rank;
    const double to_mean = dP.bottomRightCorner(n, n).rowwise().sum().norm() / dP.norm();
    mean_alone_is_left = mean_alone_is_left && rank_of(dP, 1e-6).rank == n - 1 && rank == n && to_mean < 1e-6;
    return {{"{} of {}", rank, n + 1}, rank == n + 1};
  });
  return assessed(
      "3.8-controllable", "Example 3.8, Section 3.3",
      "Decorrelating the map makes the system controllable: rank n + 1 with n landmarks",
      {.rule = Rule::dimension,
       .measured = "rank of [G Q^1/2, dP^1/2] by number of landmarks n: " + cases.text(),
       .number = exactly("rank of [G Q^1/2, dP^1/2] with two landmarks, of 3", of_two),
       .why = "the dP of least trace has rank n - 1: it reaches the differences between landmarks and "
              "leaves their mean alone, so that the rank is n"},
      cases.hold(), in_truth(mean_alone_is_left));
}

/// A case of (3.29): what is added, and whether the covariance then stays bounded.
struct Case {
  std::string name;
  int rank, with_noise, observable;
  bool bounded;  ///< growth of the trace from step 300 to 600
};

Case case_of(const std::string& name, const Setup& setup, const MatrixXd& dP, double growth) {
  return {fmt::format("{} with {}", name, setup.landmarks), rank_of(dP, 1e-6).rank, excited(setup, dP).rank,
          rank_of(observability_matrix(system(setup))).rank, growth < bounded_growth};
}

Case inflated_case(int n, Decorrelated what) {
  const Setup setup{.landmarks = n, .decorrelated = what, .steps = 600};
  const Course course = monobot::course(setup);
  return case_of(name(what), setup, course.inflation[600],
                 growth_between(course.posterior[300].trace(), course.posterior[600].trace()));
}

/// The same noise of 0.05 m a step on every landmark, and on the robot too if asked.
Case constant_case(int n, bool robot_too) {
  const Setup setup{.landmarks = n};
  const LinearSystem noisy = with_constant_noise(setup, robot_too);
  const MatrixXd at_300 = filtered(noisy, start_of(setup), 300), at_600 = filtered(noisy, at_300, 300);
  return case_of(robot_too ? "constant on all" : "constant", setup, constant_noise(setup, robot_too),
                 growth_between(at_300.trace(), at_600.trace()));
}

std::vector<Claim> rank_condition() {
  std::vector<Case> tried;
  for (const int n : {1, 2, 3, 4}) {
    tried.push_back(inflated_case(n, Decorrelated::map));
    tried.push_back(inflated_case(n, Decorrelated::everything));
    tried.push_back(constant_case(n, false));
    tried.push_back(constant_case(n, true));
  }
  bool only_when = true, with_noise = true;
  int unbounded = 0;  // although rank dP <= rank O
  std::vector<std::string> ranks;
  for (const Case& c : tried) {
    only_when = only_when && (!c.bounded || c.rank <= c.observable);
    with_noise = with_noise && c.bounded == (c.with_noise <= c.observable);
    if (!c.bounded && c.rank <= c.observable) ++unbounded;
    if (c.name.ends_with(" 2"))
      ranks.push_back(fmt::format("{}: {}, {}, {} {}", c.name, c.rank, c.with_noise, c.observable,
                                  c.bounded ? "bounded" : "unbounded"));
  }
  return {
      assessed(
          "3.8-rank-condition", "(3.29)",
          "Partially observable SLAM with an inflated covariance converges only when rank dP <= rank O; "
          "tested with the map decorrelated, everything decorrelated, and a constant noise on all "
          "landmarks, with and without the robot, 1 to 4 of them",
          {.rule = Rule::example,
           .measured = {"in all {} cases; rank dP, rank [G Q^1/2, dP^1/2], rank O with two landmarks: {}",
                        tried.size(), fmt::join(ranks, "; ")},
           .runs = tried.size()},
          only_when),
      assessed(
          "3.8-rank-enough", "(3.29), as it is used in Section 3.3",
          "rank dP <= rank O is enough as well: a noise on as many states as can be observed leaves the "
          "covariance bounded; the same cases",
          {.rule = Rule::example,
           .measured = {"of {} cases {} grow without bound although rank dP <= rank O", tried.size(),
                        unbounded},
           .number =
               exactly(fmt::format("of {} cases unbounded with rank dP <= rank O", tried.size()), unbounded),
           .why =
               "it is not enough. What separates the cases is rank [G Q^1/2, dP^1/2] <= rank O: the process "
               "noise counts",
           .runs = tried.size()},
          unbounded == 0, in_truth(with_noise))};
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
