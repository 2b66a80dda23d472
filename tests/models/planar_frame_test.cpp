// Frames on the plane: Jacobians against automatic differentiation, inverses, and the F of rigid motions.
#include "incognita/models/motion/planar_frame.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "incognita/models/sensors/position_fix.hpp"
#include "tests/models/dual.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Vector3d> frame_poses() {
  const double pi = std::numbers::pi;
  return {{0, 0, 0}, {1, -2, pi}, {-3, 4, -pi + 1e-9}, {0.1, 0.2, pi / 2}, {7e4, -7, -2}, {1e-9, 0, 1e-12}};
}

template <class S>
Eigen::Matrix<S, 2, 1> into(const Eigen::Matrix<S, 3, 1>& frame, const Eigen::Matrix<S, 2, 1>& p) {
  using std::cos, std::sin;
  const S c = cos(frame[2]), s = sin(frame[2]), x = p[0] - frame[0], y = p[1] - frame[1];
  return {c * x + s * y, c * y - s * x};
}

template <class S>
Eigen::Matrix<S, 2, 1> out_of(const Eigen::Matrix<S, 3, 1>& frame, const Eigen::Matrix<S, 2, 1>& p) {
  using std::cos, std::sin;
  const S c = cos(frame[2]), s = sin(frame[2]);
  return {frame[0] + c * p[0] - s * p[1], frame[1] + s * p[0] + c * p[1]};
}

TEST(PlanarFrame, PointJacobiansAreExact) {
  using D = Dual<5>;
  for (const Vector3d& frame : frame_poses())
    for (const Vector2d& point : {Vector2d(0, 0), Vector2d(3, -4), Vector2d(1e5, 1)}) {
      const planar::FramedPoint in = planar::in_frame(frame, point), out = planar::out_of_frame(frame, point);
      const auto a = into<D>(variables<5>(frame), variables<5>(point, 3));
      const auto b = out_of<D>(variables<5>(frame), variables<5>(point, 3));
      const auto Ja = derivatives<5, 2>(a), Jb = derivatives<5, 2>(b);
      EXPECT_LE((in.by_frame - Ja.leftCols<3>()).norm(), 1e-12 * Ja.norm());
      EXPECT_LE((in.by_point - Ja.rightCols<2>()).norm(), 1e-12 * Ja.norm());
      EXPECT_LE((out.by_frame - Jb.leftCols<3>()).norm(), 1e-12 * Jb.norm());
      EXPECT_LE((out.by_point - Jb.rightCols<2>()).norm(), 1e-12 * Jb.norm());
      EXPECT_LE((planar::out_of_frame(frame, in.point).point - point).norm(), 1e-10);
    }
}

TEST(PlanarFrame, PosesComposeAndInvert) {
  for (const Vector3d& frame : frame_poses())
    for (const Vector3d& pose : frame_poses()) {
      const planar::FramedPose seen = planar::in_frame(frame, pose), world = planar::inverse(frame);
      // the frame in world axes, the world in frame axes: their composition is the identity
      const planar::FramedPose back = planar::in_frame(world.pose, seen.pose);
      EXPECT_LE((back.pose.head<2>() - pose.head<2>()).norm(), 1e-9 * (1 + frame.norm() + pose.norm()));
      EXPECT_NEAR(wrap_angle(back.pose[2] - pose[2]), 0, 1e-12);
      EXPECT_NEAR(seen.by_frame(2, 2), -1, 0);
      EXPECT_NEAR(seen.by_pose(2, 2), 1, 0);
      const planar::FramedPoint at = planar::in_frame(frame, Vector2d(pose.head<2>()));
      EXPECT_EQ(seen.by_frame.topRows<2>(), at.by_frame);
    }
}

/// A lemma for all vehicles: the F of a rigid motion depends on the two poses alone.
TEST(PlanarFrame, JacobianBetweenPosesIsTheFOfEveryVehicle) {
  const DifferentialDrive drive{0.7, -0.3};
  AckermannCar car;
  car.body = {3.78, 0.5};
  for (const Vector3d& x : frame_poses())
    for (const Vector2d& u : {Vector2d(1, 0.3), Vector2d(-2, 0), Vector2d(0, -0.5)}) {
      for (const planar::Step& step : {drive.step(x, u, 0.2), car.step(x, u, 0.2)}) {
        EXPECT_LE((planar::jacobian_between(x, step.x) - step.F).norm(), 1e-12 * (1 + x.norm()));
      }
    }
}

TEST(PositionFix, IsThePositionOfThePose) {
  for (const Vector3d& x : frame_poses()) {
    const PositionFix::Prediction prediction = PositionFix::predict_measurement(x);
    EXPECT_EQ(prediction.z, x.head<2>());
    EXPECT_EQ(prediction.Hv * x, x.head<2>());
  }
}

}  // namespace
}  // namespace incognita
