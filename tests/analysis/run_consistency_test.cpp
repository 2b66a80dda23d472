#include "incognita/analysis/evaluation/run_consistency.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

/// Share of 400 runs with a verdict: pose errors of `dof` numbers, a Gauss-Markov process over the given
/// number of frames with correlation `phi` of neighbors, `factor` times as large as the filter's sigma.
double share(Consistency verdict, double phi, int dof, double factor) {
  constexpr int runs = 400, frames = 1000;
  int count = 0;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    RandomStream noise(seed, "errors");
    std::vector<double> error(static_cast<std::size_t>(dof));
    for (double& e : error) e = noise.normal();
    double sum = 0;
    for (int k = 0; k < frames; ++k)
      for (double& e : error) {
        sum += factor * factor * e * e / dof;
        e = phi * e + std::sqrt(1 - phi * phi) * noise.normal();
      }
    count += mean_nees_of_run(sum / frames, frames, dof)->verdict() == verdict;
  }
  return static_cast<double>(count) / runs;
}

TEST(MeanNees, AcceptsAConsistentFilterWithCorrelatedErrors) {
  for (const double phi : {0.0, 0.9, 0.999, 1.0}) {
    EXPECT_GE(share(Consistency::consistent, phi, 6, 1), 0.975) << phi;
    EXPECT_GE(share(Consistency::consistent, phi, 3, 1), 0.975) << phi;
  }
}

TEST(MeanNees, RejectsAnOverconfidentFilterWithShortErrors) {
  for (const double phi : {0.0, 0.9}) {
    EXPECT_GE(share(Consistency::overconfident, phi, 6, 2.2), 0.99) << phi;
    EXPECT_GE(share(Consistency::conservative, phi, 6, 0.25), 0.99) << phi;
  }
}

TEST(MeanNees, HasTheBandOfOneSample) {
  const auto pose = mean_nees_of_run(1, 1000, 6);
  EXPECT_NEAR(pose->band.low, chi_square_quantile(0.005, 6) / 6, 1e-9);
  EXPECT_NEAR(pose->band.high, chi_square_quantile(0.995, 6) / 6, 1e-9);
  EXPECT_FALSE(mean_nees_of_run(1, fewest_samples - 1, 6));
  EXPECT_FALSE(mean_nees_of_run(1, 100, 0));
}

TEST(MeanNis, ToleratesApproximateModels) {
  EXPECT_EQ(mean_nis_of_run(1.3, 5000, 1e5)->verdict(), Consistency::consistent);
  EXPECT_EQ(mean_nis_of_run(2.1, 5000, 1e5)->verdict(), Consistency::overconfident);
  EXPECT_EQ(mean_nis_of_run(0.4, 5000, 1e5)->verdict(), Consistency::conservative);
  EXPECT_EQ(mean_nis_of_run(2.1, 10, 10)->verdict(), Consistency::consistent)
      << "too few samples for a verdict";
  EXPECT_FALSE(mean_nis_of_run(1, fewest_samples - 1, 100));
}

}  // namespace
}  // namespace incognita
