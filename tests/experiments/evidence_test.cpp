// Texts and verdicts of claims.
#include "experiments/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/comparisons.hpp"

namespace incognita {
namespace {

TEST(Evidence, TextOfAnInterval) { EXPECT_EQ(text({0.158, 0.143, 0.1761}, "m"), "0.158 m (0.143 to 0.176)"); }

TEST(Evidence, ValuesNearZeroAreBelowAPowerOfTen) {
  EXPECT_EQ(below(0), "below 1e-12");
  EXPECT_EQ(below(-3e-16), "below 1e-12");
  EXPECT_EQ(below(2.7e-12), "below 1e-11");
  EXPECT_EQ(below(4e-5), "below 1e-4");
}

TEST(Evidence, TextsContainNoInfinityAndNoNan) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text({0.158, -inf, inf}, "m"), "0.158 m (too few runs for an interval)");
  EXPECT_EQ(text({std::nan(""), -inf, inf}, "m"), "unknown (no runs to compare)");
  EXPECT_EQ(text({inf, 3, inf}, "s"), "unknown (no runs to compare)");
  EXPECT_EQ(decimals(1.2345, 2), "1.23");
  EXPECT_EQ(decimals(std::nan(""), 2), "unknown");
  EXPECT_EQ(decimals(-inf, 2), "unknown");
}

TEST(Answer, AnIntervalThatContainsTheLimitIsUndecided) {
  EXPECT_EQ(is_above({2, 1, 3}, 0), Answer::shown);
  EXPECT_EQ(is_above({-2, -3, -1}, 0), Answer::refuted);
  EXPECT_EQ(is_above({1, -1, 3}, 0), Answer::undecided);
  EXPECT_EQ(is_below({-2, -3, -1}, 0), Answer::shown);
  EXPECT_EQ(is_below({2, 1, 3}, 0), Answer::refuted);
  EXPECT_EQ(is_below({1, -1, 3}, 0), Answer::undecided);
  const double nan = std::nan("");
  EXPECT_EQ(is_above({nan, nan, nan}, 0), Answer::undecided);
  EXPECT_EQ(is_below({nan, nan, nan}, 0), Answer::undecided);
}

TEST(Answer, EqualityHasAMargin) {
  EXPECT_EQ(agrees({1.01, 0.95, 1.07}, 1, 0.1), Answer::shown);
  EXPECT_EQ(agrees({1.3, 1.2, 1.4}, 1, 0.1), Answer::refuted);
  EXPECT_EQ(agrees({0.7, 0.6, 0.8}, 1, 0.1), Answer::refuted);
  EXPECT_EQ(agrees({1.0, 0.5, 1.5}, 1, 0.1), Answer::undecided);
  EXPECT_EQ(agrees({1.1, 1.05, 1.15}, 1, 0.1), Answer::undecided);
  EXPECT_EQ(differs({0.1, 0.05, 0.15}, 0), Answer::shown);
  EXPECT_EQ(differs({0.1, -0.05, 0.25}, 0), Answer::undecided);
}

TEST(Answer, SharesNeedRuns) {
  EXPECT_EQ(happens_in(0.95, 200, 200), Answer::shown);
  EXPECT_EQ(happens_in(0.95, 20, 20), Answer::undecided);
  EXPECT_EQ(happens_in(0.95, 10, 20), Answer::refuted);
  EXPECT_EQ(happens_in(0.95, 0, 0), Answer::undecided);
}

TEST(Answer, CombineByKleenesLogic) {
  const Answer yes = true, no = false, open = Answer::undecided;
  EXPECT_EQ(yes && open, open);
  EXPECT_EQ(no && open, no);
  EXPECT_EQ(yes || open, yes);
  EXPECT_EQ(no || open, open);
  EXPECT_EQ(!open, open);
  EXPECT_EQ(!yes, no);
}

TEST(Evidence, ReasonsStayOnlyWithVerdictsThatNeedThem) {
  Claim claim;
  claim.why = "because";
  EXPECT_EQ(assessed(claim, true).finding, Finding::holds);
  EXPECT_EQ(assessed(claim, true).why, "");
  EXPECT_EQ(assessed(claim, false, as_corrected(true)).finding, Finding::misprint);
  EXPECT_EQ(assessed(claim, false, on_condition(true)).finding, Finding::holds_if);
  EXPECT_EQ(assessed(claim, false, in_truth(true)).finding, Finding::does_not_hold);
  EXPECT_EQ(assessed(claim, false, as_corrected(false)).finding, Finding::does_not_hold);
  EXPECT_EQ(assessed(claim, false).finding, Finding::does_not_hold);
  EXPECT_EQ(assessed(claim, false, in_truth(true)).why, "because");
  claim.why.clear();
  EXPECT_EQ(assessed(claim, false, in_truth(true)).why, "not investigated");
  EXPECT_EQ(assessed(claim, false).why, "not investigated");
  EXPECT_EQ(assessed(claim, true).why, "");
}

TEST(Evidence, AReasonThatIsNotShownIsNotPrinted) {
  Claim claim;
  claim.why = "because";
  EXPECT_EQ(assessed(claim, false).why, "not investigated");
  EXPECT_EQ(assessed(claim, false, in_truth(false)).why, "not investigated");
  EXPECT_EQ(assessed(claim, false, as_corrected(false)).why, "not investigated");
  EXPECT_EQ(assessed(claim, false, in_truth(Answer::undecided)).why,
            "not known: whether it is as was tested, the interval leaves open");
}

TEST(Evidence, NotSignificantIsNotFalse) {
  Claim claim;
  claim.why = "because it is false";
  const Answer open = Answer::undecided;
  EXPECT_EQ(assessed(claim, open).finding, Finding::undecided);
  EXPECT_EQ(assessed(claim, open).why, "the interval holds both answers");
  EXPECT_EQ(assessed(claim, open, as_corrected(true)).finding, Finding::undecided);
  EXPECT_EQ(assessed(claim, false, as_corrected(open)).finding, Finding::undecided);
  EXPECT_EQ(assessed(claim, false, in_truth(open)).finding, Finding::does_not_hold);
  EXPECT_EQ(assessed(claim, true, as_corrected(open)).finding, Finding::holds);
}

TEST(Evidence, TooFewRunsAreUndecided) {
  Claim claim;
  claim.runs = 4, claim.least_runs = enough_runs;
  for (const bool is_so : {true, false}) {
    EXPECT_EQ(assessed(claim, is_so).finding, Finding::undecided);
    EXPECT_EQ(assessed(claim, is_so).why, "it rests on 4 runs, and takes at least 20");
  }
  claim.runs = enough_runs;
  EXPECT_EQ(assessed(claim, true).finding, Finding::holds);
}

const Comparison shown = claimed_below("standing", {"less", {-3, -4, -2}}, 0),
                 barely = claimed_below("a path", {"barely less", {-1, -1.9, -0.1}}, 0),
                 refuted = claimed_below("at random", {"more", {2, 1, 3}}, 0),
                 open_answer = claimed_below("a sweep", {"open", {9, -1, 20}}, 0);

TEST(Comparisons, AClaimIsCitedByTheOneItTurnsOn) {
  EXPECT_EQ(deciding({shown, barely}).what, "barely less");
  EXPECT_EQ(deciding({shown, barely, open_answer}).what, "open");
  EXPECT_EQ(deciding({shown, open_answer, refuted}).what, "more");
  const Comparison above = claimed_above("a", {"far above", {9, 8, 10}}, 0),
                   near = claimed_above("b", {"just above", {1, 0.5, 1.5}}, 0);
  EXPECT_EQ(deciding({above, near}).what, "just above");
}

TEST(Comparisons, AreShownIfAllAre) {
  EXPECT_EQ(all_shown({shown, barely}), Answer::shown);
  EXPECT_EQ(all_shown({shown, open_answer}), Answer::undecided);
  EXPECT_EQ(all_shown({shown, open_answer, refuted}), Answer::refuted);
  EXPECT_EQ(any_shown({refuted, open_answer}), Answer::undecided);
  EXPECT_EQ(any_shown({refuted, open_answer, shown}), Answer::shown);
}

TEST(Comparisons, TheConditionNamesAllRivals) {
  EXPECT_EQ(condition("less than", {open_answer, refuted, shown, barely}),
            "less than standing, a path; not less than at random; undecided against a sweep");
  EXPECT_EQ(condition("less than", {refuted}), "not less than at random");
}

}  // namespace
}  // namespace incognita
