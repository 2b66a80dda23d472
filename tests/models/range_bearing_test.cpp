// Range and bearing: exact Jacobians, and initialization as the inverse of the measurement.
#include "incognita/models/sensors/range_bearing.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "incognita/models/motion/monobot.hpp"
#include "tests/models/dual.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Dual5 = Dual<5>;

/// Ahead, abeam, behind on either side of the wrap, at a micrometer and at a hundred kilometers.
std::vector<Vector2d> places() {
  std::vector<Vector2d> all;
  for (const double range : {2e-6, 1e-3, 1.0, 30.0, 1e5})
    for (const double bearing : {0.0, 1e-9, 0.7, std::numbers::pi / 2, -std::numbers::pi / 2,
                                 std::numbers::pi - 1e-7, -std::numbers::pi + 1e-7, -2.5})
      all.push_back({range, bearing});
  return all;
}

std::vector<Vector3d> poses() {
  return {{0, 0, 0}, {1, -2, std::numbers::pi}, {-3, 4, -3.1415}, {0.1, 0.2, 1.5707963267948966}, {7, 7, -2}};
}

TEST(RangeBearing, JacobiansAreExact) {
  for (const Vector3d& pose : poses())
    for (const Vector2d& z : places()) {
      const Vector2d point = RangeBearing::j<double>(pose, z);
      const auto prediction = RangeBearing::predict_measurement(pose, point);
      ASSERT_TRUE(prediction);
      const auto J = derivatives<5, 2>(RangeBearing::h<Dual5>(variables<5>(pose), variables<5>(point, 3)));
      EXPECT_LE((prediction->Hv - J.leftCols<3>()).norm(), 1e-12 * J.norm())
          << pose.transpose() << " " << z.transpose();
      EXPECT_LE((prediction->Hl - J.rightCols<2>()).norm(), 1e-12 * J.norm())
          << pose.transpose() << " " << z.transpose();
      const auto initialization = RangeBearing::initialize(pose, z);
      const auto B = derivatives<5, 2>(RangeBearing::j<Dual5>(variables<5>(pose), variables<5>(z, 3)));
      EXPECT_LE((initialization.Jv - B.leftCols<3>()).norm(), 1e-14 * B.norm());
      EXPECT_LE((initialization.Jz - B.rightCols<2>()).norm(), 1e-14 * B.norm());
    }
}

TEST(RangeBearing, InitializationIsTheInverseOfTheMeasurement) {
  for (const Vector3d& pose : poses())
    for (const Vector2d& z : places()) {
      const auto prediction =
          RangeBearing::predict_measurement(pose, RangeBearing::initialize(pose, z).landmark);
      ASSERT_TRUE(prediction);
      Vector2d difference;
      RangeBearing::chart.minus({prediction->z.data(), 2}, {z.data(), 2}, {difference.data(), 2});
      // Rounding of positions of some meters at distance z[0]
      EXPECT_LE(std::abs(difference[0]), 1e-15 * (20 + z[0])) << pose.transpose() << " " << z.transpose();
      EXPECT_LE(std::abs(difference[1]), 1e-15 * (20 + 20 / z[0]))
          << pose.transpose() << " " << z.transpose();
      EXPECT_LE(std::abs(prediction->z[1]), std::numbers::pi);
    }
}

TEST(RangeBearing, IsUndefinedAtTheSensor) {
  EXPECT_FALSE(RangeBearing::predict_measurement({1, 2, 3}, {1, 2}));
  EXPECT_FALSE(RangeBearing::predict_measurement({1, 2, 3}, {1, NAN}));
}

TEST(RangeBearing, LeftIsPositiveAndAheadIsZero) {
  const auto ahead = RangeBearing::predict_measurement({1, 1, std::numbers::pi / 2}, {1, 3});
  const auto left = RangeBearing::predict_measurement({1, 1, std::numbers::pi / 2}, {0, 1});
  EXPECT_NEAR(ahead->z[0], 2, 1e-15);
  EXPECT_NEAR(ahead->z[1], 0, 1e-15);
  EXPECT_NEAR(left->z[1], std::numbers::pi / 2, 1e-15);
}

TEST(RelativePosition, InitializationIsTheInverseOfTheMeasurement) {
  EXPECT_EQ(RelativePosition::predict_measurement(-1, 1).z[0], 2);
  EXPECT_EQ(RelativePosition::initialize(-1, 2).landmark[0], 1);
  EXPECT_EQ(RelativePosition::predict_measurement(-1, 1).Hv[0], -1);
  EXPECT_EQ(RelativePosition::predict_measurement(-1, 1).Hl[0], 1);
}

}  // namespace
}  // namespace incognita
