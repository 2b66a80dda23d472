#include "incognita/analysis/evaluation/map_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points random_points(RandomStream& random, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(random.uniform(-20, 20), random.uniform(-20, 20));
  return points;
}

TEST(FitRigid, RecoversARigidMotion) {
  RandomStream random(1, "fit");
  for (int run = 0; run < 50; ++run) {
    const PlanarFit made{random.uniform(-3.1, 3.1), {random.uniform(-5, 5), random.uniform(-5, 5)}};
    const Points from = random_points(random, 2 + random.below(10));
    Points to;
    for (const auto& p : from) to.push_back(made(p));
    const PlanarFit found = fit_rigid(from, to);
    EXPECT_NEAR(std::remainder(found.turn_rad - made.turn_rad, 2 * M_PI), 0, 1e-9);
    EXPECT_LE((found.shift - made.shift).norm(), 1e-9);
  }
}

TEST(FitRigid, IsALocalMinimum) {
  RandomStream random(2, "least");
  const Points from = random_points(random, 6);
  Points to = random_points(random, 6);
  const auto cost = [&](const PlanarFit& fit) {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i) sum += (fit(from[i]) - to[i]).squaredNorm();
    return sum;
  };
  const PlanarFit best = fit_rigid(from, to);
  for (int i = 0; i < 500; ++i) {
    PlanarFit other = best;
    other.turn_rad += 0.01 * random.normal();
    other.shift += 0.1 * Eigen::Vector2d(random.normal(), random.normal());
    EXPECT_GE(cost(other), cost(best));
  }
  EXPECT_THROW(fit_rigid(from, {}), std::invalid_argument);
  EXPECT_EQ(fit_rigid({}, {}).turn_rad, 0);
}

TEST(MapError, MatchesOneToOneAndReportsTheRest) {
  const Points surveyed{{0, 0}, {10, 0}, {0, 10}}, estimated{{0.1, 0}, {0.3, 0}, {10, 0.2}, {50, 50}};
  const MapError error = map_error(estimated, surveyed, 1);
  ASSERT_EQ(error.matches.size(), 2u);
  EXPECT_EQ(error.matches[0].estimated, 0u);
  EXPECT_EQ(error.matches[1].surveyed, 1u);
  EXPECT_EQ(error.twice, std::vector<std::size_t>{1});
  EXPECT_EQ(error.unmatched, std::vector<std::size_t>{3});
  EXPECT_EQ(error.missing, std::vector<std::size_t>{2});
  EXPECT_NEAR(error.rms_m, std::sqrt((0.01 + 0.04) / 2), 1e-12);
  EXPECT_TRUE(std::isnan(map_error({}, surveyed, 1).rms_m));
}

TEST(FittedMapError, CorrectsAnApproximateInitialAlignment) {
  RandomStream random(3, "rough");
  const Points surveyed = random_points(random, 12);
  const PlanarFit made{0.4, {2, -1}};
  Points estimated;
  for (const auto& p : surveyed) {
    PlanarFit back;
    back.turn_rad = -made.turn_rad;
    estimated.push_back(back(p - made.shift) + 0.01 * Eigen::Vector2d(random.normal(), random.normal()));
  }
  const FittedMapError fitted = fitted_map_error(estimated, surveyed, 2, {0.37, {1.8, -0.9}});
  EXPECT_EQ(fitted.error.matches.size(), surveyed.size());
  EXPECT_LT(fitted.error.rms_m, 0.03);
  EXPECT_NEAR(fitted.fit.turn_rad, made.turn_rad, 0.01);
}

}  // namespace
}  // namespace incognita
