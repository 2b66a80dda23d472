// What the abstract says of partial observability, as far as the linear case decides it; the nonlinear part is
// in consistency.cpp.
//
// Experiment: the monobot of monobot.hpp with 1 and 2 landmarks; errors after 100 and 1000 steps, with and
// without the anchor; NEES after 100 steps over ten times as many runs; the trace with everything and with only
// the map decorrelated, from step 500 to 1000.
#include "experiments/boundedness.hpp"
#include "experiments/common.hpp"
#include "experiments/linear_filter.hpp"
#include "experiments/text_claims.hpp"

namespace incognita {
namespace {

using namespace monobot;

Claim linear_case_shows_effects(int seeds) {
  const auto of_landmark = [](const std::vector<monobot::Run>& runs, int step) {
    return errors(runs, 1, step);
  };
  const auto free = simulate_all({.steps = 1000}, seeds),
             anchored = simulate_all({.anchored = true, .steps = 1000}, seeds);
  const Interval early = rms_of(of_landmark(free, 100)), late = rms_of(of_landmark(free, 1000));
  const Interval more = mean_of(squares_less(of_landmark(anchored, 1000), of_landmark(free, 1000)));
  return assessed(
      "abstract-linear-effects", "Abstract",
      "Effects of partial observability appear in the linear Gaussian case: without an anchor the "
      "landmark's error does not fall (rms after 1000 steps as after 100, to 1 %), and it is larger than "
      "with one in paired runs",
      {.rule = Rule::superiority,
       .measured = {"rms after 100 and 1000 steps: {} and {}, with an anchor after 1000 {}; mean square "
                    "more by {}",
                    text(early, "m"), text(late, "m"), text(rms_of(of_landmark(anchored, 1000)), "m"),
                    text(more, "m^2")},
       .number = ClaimNumber{"landmark's rms error after 1000 steps, no anchor", late, "m"},
       .seeds = seeds},
      std::abs(late.value / early.value - 1) < 0.01 && is_above(more, 0));
}

Claim linear_case_is_inconsistent(int seeds) {
  const int count = 10 * seeds;
  Interval of_one;
  const Cases consistent = by_number({1, 2}, [&](int n) -> CaseResult {
    const Setup setup{.landmarks = n};
    const Interval nees = mean_of(
        each(simulate_all(setup, count), [&](const monobot::Run& run) { return run.nees[setup.steps]; }));
    if (n == 1) of_one = nees;
    return {text(nees), is_consistent(nees)};
  });
  return assessed(
      "abstract-inconsistency", "Abstract",
      "Linearisation alone is not the only cause of inconsistency: partial observability makes the linear filter "
      "inconsistent (mean NEES over its degrees of freedom, after 100 steps without an anchor, not within 0.2 of 1)",
      {.rule = Rule::equality,
       .measured = "NEES by number of landmarks: " + consistent.text(),
       .number = ClaimNumber{"mean NEES of the linear filter without an anchor", of_one},
       .why =
           "it is consistent: the constant error that partial observability leaves is as large as the covariance "
           "says",
       .seeds = count},
      !consistent.hold(), in_truth(consistent.hold()));
}

Claim diagonalization_needs_observability() {
  const auto growth = [](Decorrelated what, bool anchored) {
    const auto P =
        course({.landmarks = 2, .anchored = anchored, .decorrelated = what, .steps = 1000}).posterior;
    return growth_between(P[500].trace(), P[1000].trace());
  };
  const double all = growth(Decorrelated::everything, false), map = growth(Decorrelated::map, false),
               anchored = growth(Decorrelated::everything, true);
  return assessed(
      "abstract-diagonalisation", "Abstract",
      "Full observability is necessary when the covariance is diagonalised: without an anchor, the trace grows by "
      "more than 5 % in the second half of 1000 steps, both with everything and with only the map decorrelated",
      {.rule = Rule::boundedness,
       .measured =
           {"two landmarks, growth without an anchor: everything {:.1f} %, map {:.1f} %; everything with an "
            "anchor {:.1f} %",
            100 * all, 100 * map, 100 * anchored},
       .number = exactly("growth of the trace from step 500 to 1000, map alone, no anchor",
                         std::round(1e6 * map) / 1e4, "%"),
       .why =
           "the vehicle is decorrelated from the map, too: then the covariance is unbounded without an anchor and "
           "bounded with one. With only the map decorrelated it is bounded without"},
      !is_bounded(all) && !is_bounded(map),
      on_condition(!is_bounded(all) && is_bounded(map) && is_bounded(anchored)));
}

}  // namespace

std::vector<Claim> abstract_claims(int seeds) {
  return {linear_case_shows_effects(seeds), linear_case_is_inconsistent(seeds),
          diagonalization_needs_observability()};
}

}  // namespace incognita
