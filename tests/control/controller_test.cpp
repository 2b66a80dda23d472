#include <gtest/gtest.h>

#include "incognita/control/camera_controller.hpp"
#include "incognita/control/reference.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/models/heading.hpp"

namespace incognita {
namespace {

TEST(MinimumJerk, GoesFromRestToRestWithConsistentDerivatives) {
  const Eigen::Vector3d a(1, 2, 3), b(1.3, 2, 2.9);
  EXPECT_TRUE(minimum_jerk(a, b, 2, 3, 1.5).position.isApprox(a));
  EXPECT_TRUE(minimum_jerk(a, b, 2, 3, 9).position.isApprox(b));
  EXPECT_TRUE(minimum_jerk(a, b, 2, 3, 2).velocity.isZero());
  EXPECT_TRUE(minimum_jerk(a, b, 2, 3, 3).velocity.isZero(1e-12));
  constexpr double h = 1e-5;
  for (const double t : {2.1, 2.5, 2.83}) {
    const Reference before = minimum_jerk(a, b, 2, 3, t - h), now = minimum_jerk(a, b, 2, 3, t),
                    after = minimum_jerk(a, b, 2, 3, t + h);
    EXPECT_LT(((after.position - before.position) / (2 * h) - now.velocity).norm(), 1e-8);
    EXPECT_LT(((after.velocity - before.velocity) / (2 * h) - now.acceleration).norm(), 1e-7);
  }
}

CameraState at_rest() {
  CameraState x = CameraState::Zero();
  x.segment<4>(3) = level_gaze(0);
  return x;
}

TEST(TrackReference, BringsTheConstantVelocityModelToTheGoalPose) {  // thesis (5.29) on (5.24)
  CameraState x = at_rest();
  x.head<3>() << 0.3, -0.2, 0.1;
  x.segment<4>(3) = level_gaze(0.4);
  x.segment<3>(7) << 0.2, 0, -0.1;
  const ControlSettings settings;
  for (int k = 0; k < 300; ++k) {
    const Command u = track_reference(x, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, level_gaze(0), {0, 0, 0}, settings);
    x = FreeCameraMotion{}.f<double>(x, u.as_input(), 1 / 30.0);
  }
  Eigen::Matrix<double, 12, 1> error;
  const CameraState desired = at_rest();
  FreeCameraMotion::chart.minus({x.data(), 13}, {desired.data(), 13}, {error.data(), 12});
  EXPECT_LT(error.norm(), 1e-4);
}

TEST(TrackReference, RespectsTheAccelerationLimits) {
  CameraState x = at_rest();
  x.head<3>() << 100, -100, 0;
  ControlSettings settings;
  settings.max_acceleration_m_s2 = 2;
  const Command u = track_reference(x, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, level_gaze(3), {0, 0, 0}, settings);
  EXPECT_DOUBLE_EQ(u.linear_acceleration.x(), -2);
  EXPECT_DOUBLE_EQ(u.linear_acceleration.y(), 2);
  EXPECT_LE(u.angular_acceleration.cwiseAbs().maxCoeff(), settings.max_angular_acceleration_rad_s2);
}

TEST(CameraController, BrakesFromTheLastEstimateWhenLostThenCommandsNothing) {
  Estimate estimate;
  CameraState x = at_rest();
  x.segment<3>(7) << 0.4, 0, 0;
  estimate.bodies.emplace_back().block =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, x, FreeCameraMotion::Jacobian::Identity());
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  CameraController controller({});
  controller.act(estimate, {}, {}, {0, 0, 0});
  estimate.status.state = TrackingState::lost;
  double velocity = 0.4;
  for (int k = 1; k < 60; ++k)
    velocity += controller.act(estimate, {}, {}, {k, k / 30.0, 1 / 30.0}).linear_acceleration.x() / 30;
  EXPECT_NEAR(velocity, 0, 0.03);
  EXPECT_TRUE(controller.act(estimate, {}, {}, {60, 2.0, 1 / 30.0}).linear_acceleration.isZero());
}

/// The operator sees the goal; the operator's motion is not a command.
TEST(CameraController, DisplaysTheGoalToAnOperatorAndCommandsNothing) {
  Estimate estimate;
  CameraState moving = at_rest();
  moving.segment<3>(7) << 0.4, 0, 0;
  CameraController controller({}, true);
  Goal goal;
  goal.decided = true;
  goal.to = {0, 0.3, 0};
  goal.end_t = 1;
  EXPECT_FALSE(controller.act(estimate, goal, {}, {0, 0, 0}).operator_controlled) << "not started";
  estimate.bodies.emplace_back().block =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, moving, FreeCameraMotion::Jacobian::Identity());
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  Command command = controller.act(estimate, goal, {}, {1, 0.1, 0.1});
  EXPECT_TRUE(command.operator_controlled);
  EXPECT_TRUE(command.as_input().isZero());
  ASSERT_EQ(command.user_commands.size(), 1u);
  EXPECT_EQ(command.user_commands[0].segment.to, goal.to);
  EXPECT_EQ(command.user_commands[0].segment.end_t, 1);
  EXPECT_TRUE(command.user_commands[0].is_new);
  EXPECT_FALSE(command.user_commands[0].gaze);
  goal.decided = false;
  goal.heading_rad = 0.5;
  command = controller.act(estimate, goal, {}, {2, 0.2, 0.1});
  EXPECT_FALSE(command.user_commands[0].is_new);
  EXPECT_EQ(command.user_commands[0].gaze->rad, 0.5);
  estimate.status.state = TrackingState::lost;
  command = controller.act(estimate, goal, {}, {3, 0.3, 0.1});
  EXPECT_TRUE(command.operator_controlled && command.user_commands.empty()) << "come to rest";
  EXPECT_TRUE(command.as_input().isZero());
}

}  // namespace
}  // namespace incognita
