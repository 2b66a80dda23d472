#include "incognita/math/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using std::numbers::pi;

TEST(WrapAngle, KeepsPiAndTurnsMinusPiIntoPi) {
  EXPECT_EQ(wrap_angle(pi), pi);
  EXPECT_EQ(wrap_angle(-pi), pi);
  EXPECT_EQ(wrap_angle(0.0), 0.0);
}

TEST(WrapAngle, IsContinuousAcrossTheWrap) {
  constexpr double little = 1e-9;
  EXPECT_NEAR(wrap_angle(pi + little), -pi + little, 1e-15);
  EXPECT_NEAR(wrap_angle(-pi - little), pi - little, 1e-15);
  EXPECT_EQ(wrap_angle(pi - little), pi - little);
  EXPECT_EQ(wrap_angle(-pi + little), -pi + little);
}

TEST(WrapAngle, RemovesWholeTurns) {
  EXPECT_NEAR(wrap_angle(3 * pi / 2), -pi / 2, 1e-15);
  EXPECT_NEAR(wrap_angle(-3 * pi / 2), pi / 2, 1e-15);
  EXPECT_NEAR(wrap_angle(2 * pi), 0, 1e-15);
  EXPECT_NEAR(wrap_angle(7 * 2 * pi + 0.25), 0.25, 1e-14);
}

TEST(WrapAngle, PreservesTheDirection) {
  RandomStream random(1, "wrap");
  for (int i = 0; i < 20000; ++i) {
    const double angle = random.uniform(-1, 1) * std::pow(10.0, random.uniform(-3, 4));
    const double wrapped = wrap_angle(angle);
    ASSERT_GT(wrapped, -pi) << angle;
    ASSERT_LE(wrapped, pi) << angle;
    ASSERT_NEAR(std::cos(wrapped), std::cos(angle), 1e-11) << angle;
    ASSERT_NEAR(std::sin(wrapped), std::sin(angle), 1e-11) << angle;
    ASSERT_EQ(wrap_angle(wrapped), wrapped) << angle;
  }
}

TEST(WrapAngle, StaysInRangeWithinRoundingOfEveryWrap) {
  for (int turn = -50; turn <= 50; ++turn) {
    const double seam = (2 * turn + 1) * pi;
    double below = seam, above = seam;
    for (int ulps = 0; ulps < 8; ++ulps) {
      for (const double angle : {below, above}) {
        const double wrapped = wrap_angle(angle);
        ASSERT_GT(wrapped, -pi) << "seam " << turn << ", " << ulps << " away";
        ASSERT_LE(wrapped, pi) << "seam " << turn << ", " << ulps << " away";
        ASSERT_NEAR(std::abs(wrapped), pi, 1e-12);
      }
      below = std::nextafter(below, -std::numeric_limits<double>::infinity());
      above = std::nextafter(above, std::numeric_limits<double>::infinity());
    }
  }
}

TEST(Degrees, AreTheInverseOfRadians) {
  EXPECT_DOUBLE_EQ(radians(180), pi);
  EXPECT_DOUBLE_EQ(degrees(pi / 6), 30);
  for (const double angle : {-720.0, -1.0, 0.0, 33.3, 400.0})
    EXPECT_DOUBLE_EQ(degrees(radians(angle)), angle);
}

}  // namespace
}  // namespace incognita
