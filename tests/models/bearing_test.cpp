// Bearing-only measurements: undefined cases, initialization, conversion to a point and the linearity index.
#include "incognita/models/sensors/bearing.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "incognita/models/sensors/range_bearing.hpp"
#include "tests/models/dual.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;
constexpr double pi = std::numbers::pi;

std::vector<Vector3d> bearing_poses() {
  return {{0, 0, 0}, {1, -2, pi}, {-3, 4, -3.1415}, {0.1, 0.2, pi / 2}, {7, 7, -2}};
}

TEST(Bearing, IsTheSecondRowOfRangeAndBearing) {
  for (const Vector3d& pose : bearing_poses())
    for (const Vector2d& point : {Vector2d(3, 1), Vector2d(-2, 5), Vector2d(7, -1e3)}) {
      const auto both = RangeBearing::predict_measurement(pose, point);
      const auto one = Bearing::predict_measurement(pose, point);
      EXPECT_EQ(one->z[0], both->z[1]);
      EXPECT_EQ((one->Hv - both->Hv.row(1)).norm() + (one->Hl - both->Hl.row(1)).norm(), 0);
    }
}

TEST(Bearing, IsUndefinedAtTheSensor) {
  EXPECT_FALSE(Bearing::predict_measurement({1, 2, 3}, {1, 2}));
  EXPECT_FALSE(Bearing::predict_measurement({1, 2, 3}, {1 + 1e-7, 2}));
  EXPECT_FALSE(PlanarInverseDistance::predict_measurement({1, 2, 3}, {0, 2, 0, 1}));
  EXPECT_FALSE(PlanarInverseDistance::predict_measurement({1e6, 2, 3}, {0, 2, 0, 1e-6}));
}

TEST(PlanarInverseDistance, InitializationIsTheInverseOfTheMeasurement) {
  for (const Vector3d& pose : bearing_poses())
    for (const double bearing : {0.0, 1e-9, pi / 2, -pi / 2, pi - 1e-7, -pi + 1e-7, -2.5})
      for (const double inverse : {0.0, 1e-9, 0.5, 100.0}) {
        const auto initialized = PlanarInverseDistance::initialize(pose, bearing, inverse);
        const auto prediction = PlanarInverseDistance::predict_measurement(pose, initialized.landmark);
        ASSERT_TRUE(prediction);
        EXPECT_NEAR(wrap_angle(prediction->z[0] - bearing), 0, 2e-15);
        EXPECT_EQ(initialized.landmark[3], inverse);
        // To first order too: a pose error displaces the landmark so that the predicted bearing stays
        EXPECT_LE((prediction->Hv + prediction->Hl * initialized.Jv).norm(),
                  1e-14 * (1 + prediction->Hv.norm()));
        EXPECT_LE((prediction->Hl * initialized.Jz - Eigen::RowVector2d(1, 0)).norm(), 1e-14);
      }
}

TEST(PlanarInverseDistance, InitializationJacobiansAreExact) {
  using D = Dual<5>;
  const Vector3d pose(1, -2, 3);
  const auto x = variables<5>(pose);
  const auto z = variables<5>(Vector2d(0.7, 0.2), 3);  // wraps: 3.7 rad
  const Eigen::Matrix<D, 4, 1> y(x[0], x[1], wrap_angle<D>(x[2] + z[0]), z[1]);
  const auto J = derivatives<5, 4>(y);
  const auto initialized = PlanarInverseDistance::initialize(pose, 0.7, 0.2);
  EXPECT_LE((initialized.landmark - values<5, 4>(y)).norm(), 1e-15);
  EXPECT_EQ((initialized.Jv - J.leftCols<3>()).norm() + (initialized.Jz - J.rightCols<2>()).norm(), 0);
}

TEST(PlanarInverseDistance, PointIsExactAndHasTheSameBearing) {
  using D = Dual<4>;
  for (const Vector4d& y : {Vector4d(1, 2, 0.3, 0.5), Vector4d(-3, 1, pi, 20), Vector4d(0, 0, -2, 1e-3)}) {
    const auto d = variables<4>(y);
    const Eigen::Matrix<D, 2, 1> at(d[0] + cos(d[2]) / d[3], d[1] + sin(d[2]) / d[3]);
    const auto J = derivatives<4, 2>(at);
    const auto point = PlanarInverseDistance::point(y);
    EXPECT_LE((point.J - J).norm(), 1e-14 * J.norm());
    const Vector3d pose(0.4, -0.7, 2);
    const auto by_point = Bearing::predict_measurement(pose, point.position);
    const auto by_inverse = PlanarInverseDistance::predict_measurement(pose, y);
    EXPECT_NEAR(wrap_angle(by_point->z[0] - by_inverse->z[0]), 0, 1e-14);
    EXPECT_LE((by_point->Hv - by_inverse->Hv).norm(), 1e-13);
    EXPECT_LE((by_point->Hl * point.J - by_inverse->Hl).norm(), 1e-12 * by_inverse->Hl.norm());
  }
}

TEST(PlanarInverseDistance, AtInfinityOnlyRotationMatters) {
  const Vector4d y(1, 2, 0.3, 0);
  const auto here = PlanarInverseDistance::predict_measurement({5, 6, 1}, y),
             there = PlanarInverseDistance::predict_measurement({-50, 9, 1}, y);
  EXPECT_EQ(here->z[0], there->z[0]);
  EXPECT_EQ(here->Hv, Eigen::RowVector3d(0, 0, -1));
  EXPECT_NE(here->Hl[3], 0) << "a measurement from another position depends on the distance";
}

/// The index by its definition: twice the distance's sigma times the second over the first derivative of the
/// measurement.
TEST(PlanarInverseDistance, LinearityIndexMeasuresTheCurvature) {
  const Vector4d y(0, 0, 0.4, 0.25);
  const double sigma = 0.02, sigma_distance = sigma / (y[3] * y[3]), e = 1e-3;
  for (const Vector2d& sensor : {Vector2d(1, 0), Vector2d(2, 3), Vector2d(-1, 0.5), Vector2d(5, -1)}) {
    const auto seen = [&](double further) {
      const double d = 1 / y[3] + further;
      const Vector3d pose(sensor.x(), sensor.y(), 0);
      return Bearing::h<double>(pose, Vector2d(d * std::cos(y[2]), d * std::sin(y[2])))[0];
    };
    const double first = (seen(e) - seen(-e)) / (2 * e),
                 second = (seen(e) - 2 * seen(0) + seen(-e)) / (e * e);
    const double index = PlanarInverseDistance::linearity_index(y, sigma * sigma, sensor);
    EXPECT_NEAR(index, std::abs(2 * sigma_distance * second / first), 1e-4 * (1 + index));
  }
}

TEST(PlanarInverseDistance, LinearityIndexRejectsAnUnconstrainedDistance) {
  EXPECT_GT(PlanarInverseDistance::linearity_index({0, 0, 0, 0}, 0.01, {1, 1}), 1e6);
  EXPECT_GT(PlanarInverseDistance::linearity_index({0, 0, 0, -0.1}, 0.01, {1, 1}), 1e6);
  EXPECT_GT(PlanarInverseDistance::linearity_index({0, 0, 0, 1}, 0.01, {1, 0}), 1e6) << "the landmark itself";
  // with zero parallax it never becomes a point; abeam it soon does
  EXPECT_GT(PlanarInverseDistance::linearity_index({0, 0, 0, 0.5}, 0.01, {0, 0}), 0.1);
  EXPECT_LT(PlanarInverseDistance::linearity_index({0, 0, 0, 0.5}, 0.01, {2, 5}), 1e-9);
}

}  // namespace
}  // namespace incognita
