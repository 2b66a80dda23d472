#include "incognita/math/chart.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <span>

#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"
#include "tests/math/random_direction.hpp"

namespace incognita {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

using std::numbers::pi;

std::span<double> numbers_of(VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::span<const double> numbers_of(const VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

VectorXd plus(const Chart& chart, VectorXd x, const VectorXd& delta) {
  chart.plus(numbers_of(x), numbers_of(delta));
  return x;
}

VectorXd minus(const Chart& chart, const VectorXd& y, const VectorXd& x) {
  VectorXd delta = VectorXd::Constant(chart.tangent(), std::nan(""));
  chart.minus(numbers_of(y), numbers_of(x), numbers_of(delta));
  return delta;
}

/// One part of each kind, an angle between two others.
const Chart everything{
    {Chart::Kind::line, 2}, {Chart::Kind::angle, 1}, {Chart::Kind::quaternion, 4}, {Chart::Kind::line, 1}};

/// A state of `everything`, rotated by `rotation` from the identity.
VectorXd state(RandomStream& random, double heading, const Vector3d& rotation) {
  VectorXd x(8);
  x << 10 * random.normal(), 10 * random.normal(), heading, quaternion_exp<double>(rotation), random.normal();
  return x;
}

VectorXd error(RandomStream& random, double heading, const Vector3d& rotation) {
  VectorXd d(7);
  d << random.normal(), random.normal(), heading, rotation, random.normal();
  return d;
}

void expect_same_state(const VectorXd& a, const VectorXd& b, double tolerance) {
  EXPECT_LT((a.head<2>() - b.head<2>()).norm(), tolerance);
  EXPECT_NEAR(a[2], b[2], tolerance);
  EXPECT_LT((a.segment<4>(3) * (a.segment<4>(3).dot(b.segment<4>(3)) < 0 ? -1 : 1) - b.segment<4>(3)).norm(),
            tolerance);
  EXPECT_NEAR(a[7], b[7], tolerance);
}

/// Rotation angles at which charts are ill-conditioned.
constexpr double rotations[] = {0, 1e-300, 1e-12, 1e-6, 9.9e-5, 1.01e-4, 0.01, 1, 3, pi - 1e-6, pi - 1e-10};

TEST(Chart, CountsStatesAndErrors) {
  EXPECT_EQ(everything.ambient(), 8);
  EXPECT_EQ(everything.tangent(), 7);
  EXPECT_EQ(Chart::line(5).ambient(), 5);
  EXPECT_EQ(Chart::line(5).tangent(), 5);
}

TEST(Chart, AddingZeroChangesNothing) {
  RandomStream random(1, "zero");
  for (const double angle : rotations) {
    const VectorXd x = state(random, random.uniform(-3, 3), random_direction(random) * angle);
    EXPECT_LT((plus(everything, x, VectorXd::Zero(7)) - x).norm(), 4e-16);
    EXPECT_LT(minus(everything, x, x).norm(), 4e-16) << "x (-) x";
  }
}

TEST(Chart, DifferenceRecoversWhatWasAdded) {
  RandomStream random(1, "plus then minus");
  for (const double start : rotations)
    for (const double turn : rotations)
      for (int i = 0; i < 10; ++i) {
        const VectorXd x = state(random, random.uniform(-pi, pi), random_direction(random) * start);
        const VectorXd d = error(random, random.uniform(-3.1, 3.1), random_direction(random) * turn);
        ASSERT_LT((minus(everything, plus(everything, x, d), x) - d).norm(), 2e-14)
            << start << " then " << turn;
      }
}

TEST(Chart, AddingTheDifferenceReachesTheOtherState) {
  RandomStream random(1, "minus then plus");
  for (const double from : rotations)
    for (const double to : rotations)
      for (int i = 0; i < 10; ++i) {
        const VectorXd x = state(random, random.uniform(-3.1, 3.1), random_direction(random) * from);
        const VectorXd y = state(random, random.uniform(-3.1, 3.1), random_direction(random) * to);
        expect_same_state(plus(everything, x, minus(everything, y, x)), y, 2e-14);
      }
}

TEST(Chart, AnglesAreSubtractedAcrossTheWrap) {
  const Chart heading{{Chart::Kind::angle, 1}};
  const auto one = [](double a) { return VectorXd::Constant(1, a); };
  EXPECT_NEAR(minus(heading, one(-pi + 0.1), one(pi - 0.1))[0], 0.2, 1e-15);
  EXPECT_NEAR(minus(heading, one(pi - 0.1), one(-pi + 0.1))[0], -0.2, 1e-15);
  EXPECT_NEAR(plus(heading, one(pi - 0.1), one(0.2))[0], -pi + 0.1, 1e-15);
  EXPECT_NEAR(minus(Chart::line(1), one(-pi + 0.1), one(pi - 0.1))[0], 0.2 - 2 * pi, 1e-15)
      << "a line does not wrap";
}

TEST(Chart, SmallRotationsAreTheErrorInTheBodyFrame) {
  const Chart chart{{Chart::Kind::quaternion, 4}};
  const Vector4d q = quaternion_exp<double>(Vector3d(0, 0, pi / 2));  // body x is world y
  const Vector4d tipped = plus(chart, q, Vector3d(0.1, 0, 0));
  // a rotation about body x leaves body x unchanged
  const Vector3d expected = Eigen::Vector3d(0, std::cos(0), 0);
  EXPECT_LT((rotation_matrix<double>(tipped).col(0) - expected).norm(), 1e-15);
  EXPECT_GT((rotation_matrix<double>(tipped).col(1) - rotation_matrix<double>(q).col(1)).norm(), 0.09);
}

TEST(Chart, BothSignsOfAQuaternionAreTheSameState) {
  RandomStream random(1, "sign");
  const Chart chart{{Chart::Kind::quaternion, 4}};
  for (int i = 0; i < 100; ++i) {
    const VectorXd x = quaternion_exp<double>(random_direction(random) * random.uniform(0, 3));
    const VectorXd y = quaternion_exp<double>(random_direction(random) * random.uniform(0, 3));
    EXPECT_LT((minus(chart, y, x) - minus(chart, -y, x)).norm(), 1e-12);
    EXPECT_LE(minus(chart, y, x).norm(), pi + 1e-14);
  }
}

TEST(Chart, QuaternionStaysOnTheUnitSphere) {
  RandomStream random(1, "sphere");
  VectorXd x = state(random, 0, Vector3d::Zero());
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    everything.plus(numbers_of(x),
                    numbers_of(error(random, random.normal(), 0.3 * random_direction(random))));
    worst = std::max(worst, std::abs(x.segment<4>(3).norm() - 1));
    ASSERT_LE(std::abs(x[2]), pi);
  }
  EXPECT_LT(worst, 1e-15);
}

}  // namespace
}  // namespace incognita
