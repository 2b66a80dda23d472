#include "incognita/math/quaternion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "incognita/math/random.hpp"
#include "tests/math/random_direction.hpp"

namespace incognita {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

using std::numbers::pi;

/// Angles at which a formula for rotations may be ill-conditioned: zero, either side of the switch to a
/// series, pi.
std::vector<double> angles() {
  return {0,      1e-300, 1e-20,  1e-10, 1e-6,      9.9e-6,    1e-5,      1.01e-5,
          1.9e-5, 2.1e-5, 9.9e-5, 1e-4,  1.001e-4,  1e-3,      0.1,       1,
          pi / 2, 2,      3,      3.14,  pi - 1e-6, pi - 1e-9, pi - 1e-12};
}

TEST(Skew, IsTheCrossProduct) {
  const Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_LT((skew<double>(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Quaternion, ProductIsHamiltons) {
  const Vector4d i(0, 1, 0, 0), j(0, 0, 1, 0), k(0, 0, 0, 1), minus_one(-1, 0, 0, 0);
  EXPECT_EQ(quaternion_product<double>(i, j), k);
  EXPECT_EQ(quaternion_product<double>(j, k), i);
  EXPECT_EQ(quaternion_product<double>(k, i), j);
  EXPECT_EQ(quaternion_product<double>(i, i), minus_one);
}

TEST(Quaternion, ProductComposesRotations) {
  RandomStream random(1, "product");
  for (int i = 0; i < 100; ++i) {
    const Vector4d a = quaternion_exp<double>(random_direction(random) * random.uniform(0, pi));
    const Vector4d b = quaternion_exp<double>(random_direction(random) * random.uniform(0, pi));
    const Matrix3d both = rotation_matrix<double>(quaternion_product<double>(a, b));
    EXPECT_LT((both - rotation_matrix<double>(a) * rotation_matrix<double>(b)).norm(), 1e-14);
    EXPECT_LT((quaternion_product<double>(a, quaternion_conjugate<double>(a)) - Vector4d(1, 0, 0, 0)).norm(),
              1e-15);
  }
}

TEST(Quaternion, ExpIsTheRotationAboutTheAxis) {
  RandomStream random(1, "exp");
  for (const double angle : angles()) {
    const Vector3d axis = random_direction(random);
    const Eigen::AngleAxisd expected(angle, axis);
    EXPECT_LT((rotation_exp<double>(axis * angle) - expected.toRotationMatrix()).norm(), 1e-15 * 4) << angle;
    EXPECT_NEAR(quaternion_exp<double>(axis * angle).norm(), 1, 4e-16) << angle;
  }
}

TEST(Quaternion, ExpIsAccurateForATinyAngle) {
  for (const double angle : {1e-200, 1e-12, 9.9e-5, 1.01e-4}) {
    const Vector4d q = quaternion_exp<double>(Vector3d(0, angle, 0));
    EXPECT_NEAR(q[2] / std::sin(angle / 2), 1, 1e-15) << angle;
    EXPECT_NEAR(q[0], std::cos(angle / 2), 2e-16) << angle;
  }
}

TEST(Quaternion, LogIsTheInverseOfExpUpToPi) {
  RandomStream random(1, "log");
  for (const double angle : angles()) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d e = random_direction(random) * angle;
      const Vector4d q = quaternion_exp<double>(e);
      EXPECT_LE((quaternion_log<double>(q) - e).norm(), 2e-15 * angle) << angle;
      EXPECT_EQ(quaternion_log<double>(-q), quaternion_log<double>(q))
          << "q and -q are one rotation, " << angle;
    }
  }
}

TEST(Quaternion, LogOfHalfATurnHasNormPi) {
  RandomStream random(1, "half turn");
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = random_direction(random);
    const Vector3d e = quaternion_log<double>(Vector4d(0, axis.x(), axis.y(), axis.z()));
    EXPECT_NEAR(e.norm(), pi, 1e-14);
    EXPECT_NEAR(std::abs(e.dot(axis)), pi, 1e-14);
  }
}

TEST(Quaternion, LogIsTheShorterRotation) {
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  const Vector3d e = quaternion_log<double>(quaternion_exp<double>(axis * (pi + 0.5)));
  EXPECT_LT((e - axis * (0.5 - pi)).norm(), 1e-14);
}

TEST(Quaternion, RotationMatrixIsOrthonormal) {
  RandomStream random(1, "orthonormal");
  for (int i = 0; i < 1000; ++i) {
    const Vector4d q =
        Vector4d(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    const Matrix3d r = rotation_matrix<double>(q);
    ASSERT_LT((r * r.transpose() - Matrix3d::Identity()).norm(), 4e-15);
    ASSERT_NEAR(r.determinant(), 1, 4e-15);
    const Vector3d x = random_direction(random);
    ASSERT_LT((r * x - Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * x).norm(), 4e-15);
  }
}

TEST(Quaternion, FromMatrixInEachOfShepperdsCases) {
  // the largest of w, x, y, z decides the case; ties lie between two cases
  const std::vector<Vector4d> cases = {{1, 0, 0, 0},          {0, 1, 0, 0},          {0, 0, 1, 0},
                                       {0, 0, 0, 1},          {0.9, 0.1, -0.2, 0.3}, {0.1, 0.9, -0.2, 0.3},
                                       {0.1, -0.2, 0.9, 0.3}, {0.2, 0.1, -0.3, 0.9}, {1, 1, 1, 1},
                                       {0, 1, -1, 0},         {1e-9, 1, 0, 0},       {1e-9, -0.6, 0.8, 0},
                                       {1e-12, 0, 0.6, -0.8}, {0.5, -0.5, 0.5, -0.5}};
  for (const Vector4d& numbers : cases) {
    const Vector4d q = numbers.normalized();
    const Vector4d found = quaternion_from_matrix(rotation_matrix<double>(q));
    EXPECT_GE(found[0], 0);
    EXPECT_NEAR(found.norm(), 1, 4e-16);
    EXPECT_NEAR(std::min((found - q).norm(), (found + q).norm()), 0, 4e-16 * 4) << q.transpose();
  }
}

TEST(Quaternion, FromMatrixIsTheInverseOfRotationMatrix) {
  RandomStream random(1, "matrix");
  for (int i = 0; i < 1000; ++i) {
    Vector4d q = Vector4d(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    if (q[0] < 0) q = -q;
    ASSERT_LT((quaternion_from_matrix(rotation_matrix<double>(q)) - q).norm(), 2e-15) << q.transpose();
  }
}

/// d log(exp(-e) exp(e + d)) / dd at d = 0, by central differences.
Matrix3d numeric_right_jacobian(const Vector3d& e) {
  constexpr double h = 1e-5;
  Matrix3d J;
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = h * Vector3d::Unit(k);
    const auto moved = [&](const Vector3d& to) {
      return quaternion_log<double>(
          quaternion_product<double>(quaternion_exp<double>(-e), quaternion_exp<double>(to)));
    };
    J.col(k) = (moved(e + d) - moved(e - d)) / (2 * h);
  }
  return J;
}

TEST(RightJacobian, AgreesWithDifferences) {
  RandomStream random(1, "right jacobian");
  for (const double angle :
       {0.0, 1e-9, 1e-6, 9.9e-5, 1.01e-4, 1e-3, 0.1, 1.0, 2.0, 3.0, pi, 4.0, 6.0, 12.0}) {
    for (int i = 0; i < 10; ++i) {
      const Vector3d e = random_direction(random) * angle;
      EXPECT_LT((right_jacobian(e) - numeric_right_jacobian(e)).norm(), 2e-9) << angle;
    }
  }
}

TEST(RightJacobian, IsContinuousWhereTheSeriesEnds) {
  const Vector3d axis = Vector3d(2, -1, 2) / 3;
  const Matrix3d below = right_jacobian(axis * 0.999999e-4), above = right_jacobian(axis * 1.000001e-4);
  EXPECT_LT((below - above).norm(), 1e-9);
}

TEST(RightJacobian, LeavesTheAxisUnchanged) {
  RandomStream random(1, "right jacobian axis");
  for (const double angle : angles()) {
    const Vector3d axis = random_direction(random);
    EXPECT_LT((right_jacobian(axis * angle) * axis - axis).norm(), 1e-14) << angle;
  }
}

}  // namespace
}  // namespace incognita
