// Limits of commanded velocities: of their size and of their change.
#include "incognita/control/velocity_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace incognita {
namespace {

const VelocityLimits limits{{0.3, 0.5}, 0.6, 1.0};
const Eigen::Vector2d rest(0, 0);

TEST(VelocityLimits, ApproachesTheDesiredVelocityAtTheLargestAcceleration) {
  EXPECT_TRUE(limited_velocity({0.3, 0}, rest, 0.1, limits).isApprox(Eigen::Vector2d(0.06, 0)));
  EXPECT_TRUE(limited_velocity({0.3, 0}, {0.28, 0}, 0.1, limits).isApprox(Eigen::Vector2d(0.3, 0)));
  EXPECT_TRUE(limited_velocity({-0.3, 0.5}, {0.06, 0}, 0.1, limits).isApprox(Eigen::Vector2d(0, 0.1)));
}

TEST(VelocityLimits, KeepsTheDirectionOfMotionOfWhatIsTooFast) {
  const Eigen::Vector2d v = limited_velocity({0.6, 0.5}, {0.3, 0.25}, 1, limits);
  EXPECT_TRUE(v.isApprox(Eigen::Vector2d(0.3, 0.25)));
}

TEST(VelocityLimits, NothingChangesInNoTime) {
  EXPECT_EQ(limited_velocity({0.3, 0.5}, {0.1, 0.2}, 0, limits), Eigen::Vector2d(0.1, 0.2));
  EXPECT_EQ(limited_velocity({0.3, 0.5}, {0.1, 0.2}, -1, limits), Eigen::Vector2d(0.1, 0.2));
  EXPECT_EQ(limited_velocity({0.3, 0.5}, {0.1, 0.2}, NAN, limits), Eigen::Vector2d(0.1, 0.2));
}

TEST(VelocityLimits, WhatIsNotFiniteIsZero) {
  EXPECT_EQ(limited_velocity({NAN, 0}, {0.3, 0}, 0.1, limits), rest);
  EXPECT_EQ(limited_velocity({INFINITY, 0}, {0.3, 0}, 0.1, limits), rest);
  EXPECT_TRUE(limited_velocity({0.3, 0}, {NAN, 0}, 0.1, limits).allFinite());
}

TEST(VelocityLimits, NeverExceedsALimit) {
  std::mt19937 random(1);
  std::normal_distribution<> any(0, 2);
  Eigen::Vector2d last = rest;
  for (int i = 0; i < 10000; ++i) {
    const double dt = std::abs(any(random)) / 20;
    const Eigen::Vector2d v = limited_velocity({any(random), any(random)}, last, dt, limits);
    ASSERT_LE(std::abs(v[0]), 0.3);
    ASSERT_LE(std::abs(v[1]), 0.5);
    ASSERT_LE(std::abs(v[0] - last[0]), 0.6 * dt + 1e-12);
    ASSERT_LE(std::abs(v[1] - last[1]), 1.0 * dt + 1e-12);
    last = v;
  }
}

TEST(VelocityLimits, RefusesLimitsThatAreNotPositive) {
  EXPECT_NO_THROW(limits.check());
  EXPECT_THROW((VelocityLimits{{0.3, 0.5}, 0, 1}.check()), std::invalid_argument);
  EXPECT_THROW((VelocityLimits{{0.3, 0.5}, 1, INFINITY}.check()), std::invalid_argument);
  EXPECT_THROW((VelocityLimits{{-1, 0.5}, 1, 1}.check()), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
