// Intervals and verdicts against tables and exact cases.
#include "experiments/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace incognita {
namespace {

TEST(Evidence, MeanOfThreeByStudent) {
  const Interval i = mean_of({1, 2, 3});
  EXPECT_DOUBLE_EQ(i.value, 2);
  EXPECT_NEAR(i.high - i.value, 4.302653 / std::sqrt(3), 1e-6);  // t of 2 degrees of freedom at 97.5 %
  EXPECT_NEAR(i.value - i.low, i.high - i.value, 1e-12);
}

TEST(Evidence, OneRunSaysNothingOfTheMean) {
  const Interval i = mean_of({5});
  EXPECT_TRUE(i.contains(-1e9) && i.contains(1e9));
}

TEST(Evidence, RmsByChiSquare) {
  const Interval i = rms_of(std::vector<double>(10, 2.0));
  EXPECT_DOUBLE_EQ(i.value, 2);
  EXPECT_NEAR(i.low, 2 * std::sqrt(10 / 20.48318), 1e-6);
  EXPECT_NEAR(i.high, 2 * std::sqrt(10 / 3.246973), 1e-6);
}

TEST(Evidence, SlopeOfALineIsExact) {
  const Interval i = slope_of({0, 1, 2, 5}, {1, 3, 5, 11});
  EXPECT_NEAR(i.value, 2, 1e-12);
  EXPECT_NEAR(i.high - i.low, 0, 1e-6);
}

TEST(Evidence, BandOfNees) {
  const Interval i = nees_band(5, 2);
  EXPECT_NEAR(i.low, 3.246973 / 10, 1e-6);
  EXPECT_NEAR(i.high, 20.48318 / 10, 1e-6);
}

TEST(Evidence, ExponentOfAPowerLaw) { EXPECT_NEAR(exponent_of({1, 10, 100}, {3, 0.3, 0.03}), -1, 1e-12); }

TEST(Evidence, WordsOfAnInterval) {
  EXPECT_EQ(text({0.158, 0.143, 0.1761}, "m"), "0.158 m (0.143 to 0.176)");
}

TEST(Evidence, WhatIsAsGoodAsZeroStaysBelowAPowerOfTen) {
  EXPECT_EQ(below(0), "below 1e-12");
  EXPECT_EQ(below(-3e-16), "below 1e-12");
  EXPECT_EQ(below(2.7e-12), "below 1e-11");
  EXPECT_EQ(below(4e-5), "below 1e-4");
}

TEST(Evidence, ReasonsStayOnlyWhereThereIsSomethingToExplain) {
  Claim claim;
  claim.why = "because";
  EXPECT_EQ(judged(claim, true).verdict, Verdict::holds);
  EXPECT_EQ(judged(claim, true).why, "");
  EXPECT_EQ(judged(claim, false, true).verdict, Verdict::holds_as_corrected);
  EXPECT_EQ(judged(claim, false).verdict, Verdict::does_not_hold);
  EXPECT_EQ(judged(claim, false).why, "because");
}

}  // namespace
}  // namespace incognita
