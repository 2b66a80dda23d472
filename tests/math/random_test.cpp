#include "incognita/math/random.hpp"

#include <gtest/gtest.h>

#include <climits>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace incognita {
namespace {

constexpr int draws = 100000;

// Values of an independent implementation (Python integers): a stream is the same on every machine and in
// every release.
TEST(RandomStream, MatchesTheRecordedDraws) {
  RandomStream random(1, "recorded");
  EXPECT_EQ(random.bits(), 0x693a47c8e27df397u);
  EXPECT_EQ(random.bits(), 0x78e4d0eb77236977u);
  EXPECT_EQ(random.bits(), 0x1badf68fc385c721u);
  EXPECT_EQ(RandomStream(2, "recorded").bits(), 0xb716605fd2cbe243u);
  EXPECT_EQ(RandomStream(1, "").bits(), 0x85f54936022ef6d0u);
}

TEST(RandomStream, MatchesTheRecordedNormals) {
  RandomStream random(1, "recorded");
  EXPECT_NEAR(random.normal(), -2.474625506519008, 1e-14);
  EXPECT_NEAR(random.normal(), -0.772215340249533, 1e-14);
}

TEST(RandomStream, SameSeedAndNameSameDraws) {
  RandomStream a(42, "image noise"), b(42, "image noise");
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(a.normal(), b.normal());
    ASSERT_EQ(a.uniform(), b.uniform());
    ASSERT_EQ(a.below(100), b.below(100));
  }
}

TEST(RandomStream, NormalsHaveTheirMoments) {
  RandomStream random(3, "moments");
  double first = 0, second = 0, third = 0, fourth = 0;
  for (int i = 0; i < draws; ++i) {
    const double x = random.normal();
    first += x / draws;
    second += x * x / draws;
    third += x * x * x / draws;
    fourth += x * x * x * x / draws;
  }
  const double sigmas = 4 / std::sqrt(draws);  // in units of the standard deviation of x^k
  EXPECT_NEAR(first, 0, sigmas);
  EXPECT_NEAR(second, 1, sigmas * std::sqrt(2));
  EXPECT_NEAR(third, 0, sigmas * std::sqrt(15));
  EXPECT_NEAR(fourth, 3, sigmas * std::sqrt(96));
}

TEST(RandomStream, TheTwoNormalsOfAPairAreUncorrelated) {
  RandomStream random(3, "pairs");
  double product = 0, of_squares = 0;
  for (int i = 0; i < draws; ++i) {
    const double a = random.normal(), b = random.normal();
    product += a * b / draws;
    of_squares += (a * a - 1) * (b * b - 1) / draws;
  }
  EXPECT_NEAR(product, 0, 4 / std::sqrt(draws));
  EXPECT_NEAR(of_squares, 0, 4 * 2 / std::sqrt(draws));
}

TEST(RandomStream, UniformCoversItsRangeEvenly) {
  RandomStream random(4, "uniform");
  std::vector<int> bins(20);
  double low = 1, high = 0;
  for (int i = 0; i < draws; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    low = std::min(low, x);
    high = std::max(high, x);
    ++bins[static_cast<int>(x * 20)];
  }
  EXPECT_LT(low, 2e-4);
  EXPECT_GT(high, 1 - 2e-4);
  double chi_squared = 0;
  for (const int count : bins) chi_squared += std::pow(count - draws / 20.0, 2) / (draws / 20.0);
  EXPECT_LT(chi_squared, 43.8);  // 19 degrees of freedom, 99.9 %
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-3, 5);
    ASSERT_GE(x, -3);
    ASSERT_LT(x, 5);
  }
}

TEST(RandomStream, BelowCoversEveryValue) {
  RandomStream random(5, "below");
  std::vector<int> counts(7);
  for (int i = 0; i < draws; ++i) {
    const int n = random.below(7);
    ASSERT_GE(n, 0);
    ASSERT_LT(n, 7);
    ++counts[n];
  }
  double chi_squared = 0;
  for (const int count : counts) chi_squared += std::pow(count - draws / 7.0, 2) / (draws / 7.0);
  EXPECT_LT(chi_squared, 22.5);  // 6 degrees of freedom, 99.9 %
}

TEST(RandomStream, BelowAtItsBounds) {
  RandomStream random(6, "bounds");
  int greatest = 0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(random.below(1), 0);
    const int n = random.below(INT_MAX);
    ASSERT_GE(n, 0);
    ASSERT_LT(n, INT_MAX);
    greatest = std::max(greatest, n);
  }
  EXPECT_GT(greatest, INT_MAX / 2);
  EXPECT_THROW(random.below(0), std::invalid_argument);
  EXPECT_THROW(random.below(-3), std::invalid_argument);
  try {
    random.below(-3);
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("-3"), std::string::npos) << refusal.what();
  }
}

/// The correlation of n draws of two uncorrelated streams is normal with standard deviation 1/sqrt(n).
double correlation(RandomStream a, RandomStream b) {
  double sum = 0;
  for (int i = 0; i < draws; ++i) sum += a.normal() * b.normal() / draws;
  return sum;
}

TEST(RandomStream, SimilarNamesAndSeedsAreUncorrelated) {
  const double limit = 4 / std::sqrt(draws);
  EXPECT_NEAR(correlation({1, "a"}, {1, "a"}), 1, 0.02) << "the measure itself";
  EXPECT_NEAR(correlation({1, "plant"}, {1, "plans"}), 0, limit);
  EXPECT_NEAR(correlation({1, "plant"}, {2, "plant"}), 0, limit);
  EXPECT_NEAR(correlation({0, "x"}, {1ull << 63, "x"}), 0, limit);
  EXPECT_NEAR(correlation({1, ""}, {1, "x"}), 0, limit);
}

TEST(RandomStream, DrawingFromOneDoesNotChangeAnother) {
  RandomStream busy(9, "busy"), calm(9, "calm"), alone(9, "calm");
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k <= i; ++k) busy.normal();
    ASSERT_EQ(calm.normal(), alone.normal());
  }
}

TEST(RandomStream, ACopyContinuesTheSequence) {
  RandomStream original(10, "copy");
  original.normal();  // the second half of a pair is buffered
  RandomStream copy = original;
  for (int i = 0; i < 5; ++i) ASSERT_EQ(copy.normal(), original.normal());
}

}  // namespace
}  // namespace incognita
