// Example 3.6: the monobot without an anchor, everything decorrelated before each update, with least trace.
//
// Experiment: monobot.hpp; 10000 steps with 1 landmark, 3000 with 2.
// Measured: covariances, which do not depend on chance; the landmark's errors over seeds 1, 2, ...
// Holds: unbounded when the variances grow at least as step^0.9 from step 100 on; ranks by singular values
// above 1e-6 of the largest; equalities to 1e-12 relative.
#include "experiments/common.hpp"
#include "experiments/monobot.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;
using monobot::Decorrelated;
using monobot::Setup;

Setup decorrelated(int landmarks, int steps) {
  return {.landmarks = landmarks, .decorrelated = Decorrelated::everything, .steps = steps};
}

Claim unbounded() {
  Cases cases;
  for (const auto& [n, last] : {std::pair(1, 10'000), std::pair(2, 3000)}) {
    const auto P = monobot::course(decorrelated(n, last)).posterior;
    for (const int state : {0, 1}) {
      std::vector<double> k, variance;
      for (const int step : {100, 300, 1000, last})
        k.push_back(step), variance.push_back(P[step](state, state));
      const double exponent = exponent_of(k, variance);
      cases.add({fmt::format("{} with {}: {:.3g} m^2 after 100, {:.3g} m^2 after {}, as step^{:.2f}",
                             state == 0 ? "robot" : "landmark", n, variance.front(), variance.back(), last,
                             exponent),
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
    const Setup setup = decorrelated(n, 600);
    const auto P = monobot::course(setup).prior;
    const double rate = (P[600].trace() - P[500].trace()) / 100 / (n + 1);
    const double predicted = setup.sigma_v_m * setup.sigma_v_m / (n + 1);
    return {fmt::format("{:.3g}, predicted {:.3g}", rate, predicted), std::abs(rate / predicted - 1) < 0.05};
  });
  return assessed("3.6-rate", "Example 3.6",
                  "Growth is linear in time, by s_v^2/(n + 1) a step for each state: no measurement reduces "
                  "what the process noise adds to the sum of all states; tested to 5 % after 500 steps",
                  {.measured = "m^2 a step, by number of landmarks n: " + cases.text()}, cases.hold());
}

Claim full_rank_inflation() {
  bool controllable = true;
  const Cases cases = by_number({1, 2, 4}, [&](int n) -> CaseResult {
    const Setup setup = decorrelated(n, 100);
    const MatrixXd dP = monobot::course(setup).inflation[100];
    const int rank = rank_of(dP, 1e-6).rank, with_noise = monobot::excited(setup, dP).rank;
    controllable = controllable && with_noise == n + 1;
    return {fmt::format("{} of {}, with the process noise {}", rank, n + 1, with_noise), rank == n + 1};
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
  const Setup setup = decorrelated(1, 100);
  const LinearSystem s = monobot::system(setup);
  const auto course = monobot::course(setup);
  const MatrixXd dP = course.inflation[100];
  MatrixXd G(2, 3), noise = MatrixXd::Zero(3, 3), stacked(3, 2);
  G << s.G, MatrixXd::Identity(2, 2);
  noise.topLeftCorner(1, 1) = s.Q;
  noise.bottomRightCorner(2, 2) = dP;
  stacked << MatrixXd::Zero(1, 2), dP;
  stacked(0, 0) = s.Q(0, 0);
  const MatrixXd& before = course.posterior[99];
  const MatrixXd ours = s.F * before * s.F.transpose() + G * noise * G.transpose();
  const double off = (ours - course.prior[100]).norm() / course.prior[100].norm();
  const bool fits = stacked.cols() == G.cols() && stacked.rows() == G.cols();
  return assessed("3.6-as-noise", "(3.26), (3.27)",
                  "Adding dP is the same as a process noise that enters by G' = [G I], to 1e-12",
                  {.printed = "F P F' + G' [Q; dP] G''",
                   .measured = fmt::format("[Q; dP] is {}x{} where {}x{} is needed; with [Q 0; 0 dP] the "
                                           "relative difference from the engine's inflated covariance is {}",
                                           stacked.rows(), stacked.cols(), G.cols(), G.cols(), below(off)),
                   .why = "the noises belong on the diagonal, [Q 0; 0 dP]"},
                  fits, off <= 1e-12);
}

LedgerEntry run(const ExperimentSettings& settings) {
  return entry_of(example_3_6, settings,
                  {unbounded(), how_fast(), full_rank_inflation(), inflation_is_noise(),
                   monobot::inflated("3.6-inflated", decorrelated(1, 100), settings.seeds)},
                  {monobot::four_rows("fig-3.12", "No anchor, everything decorrelated",
                                      {.decorrelated = Decorrelated::everything})});
}

}  // namespace

const Experiment example_3_6{
    "3.6", "A monobot without an anchor, everything decorrelated", {"fig-3.12"}, run};

}  // namespace incognita
