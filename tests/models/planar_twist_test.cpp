// Motion with a velocity held in body axes, and the twist of a measured pose increment.
#include "incognita/models/motion/planar_twist.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/models/dual.hpp"

namespace incognita {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::vector<Vector3d> start_poses{{0, 0, 0}, {3, -2, 3.1}, {1, 1, -2}};
const std::vector<Vector3d> held_twists{{0, 0, 0},       {1, 0, 0},       {0, 0.7, 0},  {1, -0.5, 1e-9},
                                        {1, -0.5, 1e-3}, {-0.3, 0.2, -4}, {2, 1, 31.4}, {0, 0, -1}};

TEST(PlanarTwist, IsTheLimitOfSmallSteps) {
  const Vector3d u(1.3, -0.4, 0.8);
  Vector3d x(1, -2, 2.5);
  constexpr int steps = 20000;
  const double dt = 5.0 / steps;
  for (int i = 0; i < steps; ++i) {
    const double c = std::cos(x[2]), s = std::sin(x[2]);
    x += dt * Vector3d(c * u[0] - s * u[1], s * u[0] + c * u[1], u[2]);
  }
  const Vector3d exact = PlanarTwist().f<double>(Vector3d(1, -2, 2.5), u, 5);
  EXPECT_LT((exact.head<2>() - x.head<2>()).norm(), 1e-3);
  EXPECT_NEAR(wrap_angle(exact[2] - x[2]), 0, 1e-9);
}

TEST(PlanarTwist, DrivesTheArcOfADifferentialDriveWithoutSlip) {
  const ArcMotion<DifferentialDrive> drive{};
  for (const Vector3d& x : start_poses)
    for (const double turn : {0.0, 1e-5, 0.7, -2.0}) {
      const Vector3d by_drive = drive.f<double>(x, Eigen::Vector2d(0.6, turn), 0.8);
      EXPECT_LT((by_drive - PlanarTwist().f<double>(x, Vector3d(0.6, 0, turn), 0.8)).norm(), 1e-12);
    }
}

TEST(PlanarTwist, HasTheJacobiansOfAutomaticDifferentiation) {
  for (const Vector3d& x : start_poses)
    for (const Vector3d& u : held_twists)
      for (const double dt : {0.0, 0.01, 0.5}) {
        const auto step = PlanarTwist().step(x, u, dt);
        using D = Dual<3>;
        const auto by_state = derivatives<3, 3>(PlanarTwist().f<D>(variables<3>(x), u.cast<D>().eval(), dt));
        const auto by_input = derivatives<3, 3>(PlanarTwist().f<D>(x.cast<D>().eval(), variables<3>(u), dt));
        EXPECT_LT((step.F - by_state).norm(), 1e-9) << x.transpose() << " by " << u.transpose();
        EXPECT_LT((step.G - by_input).norm(), 1e-7) << x.transpose() << " by " << u.transpose();
      }
}

TEST(TwistOfIncrement, MovesByTheIncrementWithItsCovariance) {
  Matrix3d cov;
  cov << 4e-4, 1e-4, 2e-5, 1e-4, 1e-4, -1e-5, 2e-5, -1e-5, 9e-4;
  for (const Vector3d& increment : std::vector<Vector3d>{
           {0, 0, 0}, {0.1, 0, 0}, {0.1, 0.02, 1e-7}, {0.1, 0.02, 0.3}, {-0.2, 0.1, -3.1}, {0, 0, 1}}) {
    const auto twist = twist_of_increment(increment, cov, 0.2);
    ASSERT_TRUE(twist);
    const auto step = PlanarTwist().step(Vector3d::Zero(), twist->twist, 0.2);
    EXPECT_LT((step.x - increment).norm(), 1e-12) << increment.transpose();
    EXPECT_LT((step.G * twist->cov * step.G.transpose() - cov).norm(), 1e-12) << increment.transpose();
  }
}

TEST(TwistOfIncrement, IsNoneForHalfACircleOrWithoutTime) {
  EXPECT_FALSE(twist_of_increment({0, 0, std::numbers::pi}, Matrix3d::Identity(), 1));
  EXPECT_FALSE(twist_of_increment({0, 0, -3.5}, Matrix3d::Identity(), 1));
  EXPECT_FALSE(twist_of_increment({1, 0, 0}, Matrix3d::Identity(), 0));
  EXPECT_FALSE(twist_of_increment({1, 0, 0}, Matrix3d::Identity(), std::nan("")));
}

TEST(TwistOfPoint, IsTheMotionOfARigidBody) {
  const MeasuredTwist body{{0.5, -0.1, 0.9}, 1e-3 * Matrix3d::Identity(), 0.1};
  const double forward_m = 0.7, left_m = -0.2;
  const MeasuredTwist point = twist_of_point(body, forward_m, left_m);
  const auto point_at = [&](const Vector3d& pose) {
    const double c = std::cos(pose[2]), s = std::sin(pose[2]);
    return Vector3d(pose[0] + c * forward_m - s * left_m, pose[1] + s * forward_m + c * left_m, pose[2]);
  };
  for (const Vector3d& x : start_poses) {
    const Vector3d moved_body = point_at(PlanarTwist().f<double>(x, body.twist, 0.4));
    EXPECT_LT((moved_body - PlanarTwist().f<double>(point_at(x), point.twist, 0.4)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace incognita
