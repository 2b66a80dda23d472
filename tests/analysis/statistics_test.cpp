// Confidence intervals against tables and exact cases.
#include "incognita/analysis/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/analysis/evaluation/median.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

TEST(Statistics, MeanOfThreeByStudentT) {
  const Interval i = mean_of({1, 2, 3});
  EXPECT_DOUBLE_EQ(i.value, 2);
  EXPECT_NEAR(i.high - i.value, 4.302653 / std::sqrt(3), 1e-6);  // t with 2 degrees of freedom at 97.5 %
  EXPECT_NEAR(i.value - i.low, i.high - i.value, 1e-12);
}

TEST(Statistics, OneRunHasNoIntervalOfTheMean) {
  const Interval i = mean_of({5});
  EXPECT_TRUE(i.contains(-1e9) && i.contains(1e9));
}

// For ten values the second and the ninth: 2.1 % lie outside; the third and the eighth would leave 10.9 %
TEST(Statistics, MedianByTheBinomial) {
  const Interval ten = median_interval({10, 1, 9, 2, 8, 3, 7, 4, 6, 5});
  EXPECT_DOUBLE_EQ(ten.value, 5.5);
  EXPECT_DOUBLE_EQ(ten.low, 2);
  EXPECT_DOUBLE_EQ(ten.high, 9);
  EXPECT_TRUE(std::isinf(median_interval({1, 2, 3, 4, 5}).high)) << "too few";
  EXPECT_DOUBLE_EQ(median_interval({1, 2, 3, 4, 5, 6}).high, 6);
  EXPECT_TRUE(std::isnan(median_interval({}).value));
  RandomStream random(1, "median");
  int held = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> samples;
    for (int i = 0; i < 25; ++i) samples.push_back(std::exp(random.normal()));
    held += median_interval(samples).contains(1);
  }
  EXPECT_NEAR(held / 2000.0, 0.957, 0.015) << "of a lopsided distribution";
}

TEST(Statistics, RmsByChiSquare) {
  const Interval i = rms_of(std::vector<double>(10, 2.0));
  EXPECT_DOUBLE_EQ(i.value, 2);
  EXPECT_NEAR(i.low, 2 * std::sqrt(10 / 20.48318), 1e-6);
  EXPECT_NEAR(i.high, 2 * std::sqrt(10 / 3.246973), 1e-6);
}

TEST(Statistics, SlopeOfAnExactLine) {
  const Interval i = slope_of({0, 1, 2, 5}, {1, 3, 5, 11});
  EXPECT_NEAR(i.value, 2, 1e-12);
  EXPECT_NEAR(i.high - i.low, 0, 1e-6);
}

TEST(Statistics, BandOfNees) {
  const Interval i = nees_band(5, 2);
  EXPECT_NEAR(i.low, 3.246973 / 10, 1e-6);
  EXPECT_NEAR(i.high, 20.48318 / 10, 1e-6);
}

TEST(Statistics, ExponentOfAPowerLaw) { EXPECT_NEAR(exponent_of({1, 10, 100}, {3, 0.3, 0.03}), -1, 1e-12); }

TEST(Statistics, ShareByWilson) {
  const Interval half = share_of(5, 10);  // Newcombe 1998: 0.2366 to 0.7634
  EXPECT_DOUBLE_EQ(half.value, 0.5);
  EXPECT_NEAR(half.low, 0.2366, 5e-5);
  EXPECT_NEAR(half.high, 0.7634, 5e-5);
  const Interval never = share_of(0, 20);
  EXPECT_EQ(never.low, 0);
  EXPECT_NEAR(never.high, 3.841459 / (20 + 3.841459), 1e-6);  // z^2 / (n + z^2)
  EXPECT_EQ(share_of(20, 20).high, 1);
  EXPECT_TRUE(std::isnan(share_of(0, 0).value));
}

TEST(Statistics, MedianOfOddEvenAndEmptySamples) {
  EXPECT_EQ(median_of({3, 1, 2}), 2);
  EXPECT_EQ(median_of({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median_of({})));
}

TEST(Statistics, PairedSamplesShareTheirSeed) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const PairedComparison c = compare_pairs({1, 2, 3, 4, 5, 9, none}, {2, 3, 4, 5, 5, none, 1});
  EXPECT_EQ(c.pairs, 5u);
  EXPECT_DOUBLE_EQ(c.difference.value, -0.8);
  EXPECT_DOUBLE_EQ(c.share_lower, 0.8);
  EXPECT_DOUBLE_EQ(c.share_higher, 0);
  // Among five draws the value 0 occurs k times with Bin(5, 0.2): 33 % for k = 0, 5.8 % for three or more,
  // 0.7 % for four
  EXPECT_DOUBLE_EQ(c.difference.low, -1);
  EXPECT_DOUBLE_EQ(c.difference.high, -0.4);
  EXPECT_THROW(compare_pairs({1}, {}), std::invalid_argument);
}

TEST(Statistics, BootstrapOfADifferenceIsAboutAsWideAsStudentT) {
  std::vector<double> a, b;
  for (int i = 0; i < 200; ++i) {
    b.push_back(std::sin(7.0 * i));
    a.push_back(b.back() + 0.5 + 0.3 * std::sin(11.0 * i * i));
  }
  const PairedComparison c = compare_pairs(a, b);
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(a[i] - b[i]);
  const Interval t = mean_of(differences);
  EXPECT_DOUBLE_EQ(c.difference.value, t.value);
  EXPECT_NEAR(c.difference.high - c.difference.low, t.high - t.low, 0.1 * (t.high - t.low));
  const PairedComparison again = compare_pairs(a, b);
  EXPECT_EQ(c.difference.low, again.difference.low);
  EXPECT_EQ(c.difference.high, again.difference.high);
}

TEST(Statistics, SamplesWithoutCommonSeedsAreReported) {
  const PairedComparison c = compare_pairs({}, {});
  EXPECT_EQ(c.pairs, 0u);
  EXPECT_TRUE(std::isnan(c.difference.value));
}

}  // namespace
}  // namespace incognita
