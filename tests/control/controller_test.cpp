#include <gtest/gtest.h>

#include "incognita/control/fly_segment.hpp"
#include "incognita/control/paths/reference.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/models/motion/heading.hpp"

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
    const auto u = track_reference(x, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, level_gaze(0), {0, 0, 0}, settings);
    x = FreeCameraMotion{}.f<double>(x, u, 1 / 30.0);
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
  const auto u = track_reference(x, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, level_gaze(3), {0, 0, 0}, settings);
  EXPECT_DOUBLE_EQ(u[0], -2);
  EXPECT_DOUBLE_EQ(u[1], 2);
  EXPECT_LE(u.tail<3>().cwiseAbs().maxCoeff(), settings.max_angular_acceleration_rad_s2);
}

Estimate tracking(const CameraState& x) {
  Estimate estimate;
  Body& body = estimate.bodies.emplace_back();
  body.block =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, x, FreeCameraMotion::Jacobian::Identity());
  body.state = x;
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  return estimate;
}

TEST(SteeringController, BrakesAFreeCameraFromTheLastEstimateWhenLostThenCommandsNothing) {
  CameraState x = at_rest();
  x.segment<3>(7) << 0.4, 0, 0;
  Estimate estimate = tracking(x);
  SteeringController controller({free_camera_control({})});
  const auto input = [&](int k) {
    return input_of(command_of(controller.act(estimate, {}, {}, {k, k / 30.0, 1 / 30.0}), 0), 6);
  };
  input(0);
  estimate.status.state = TrackingState::lost;
  double velocity = 0.4;
  for (int k = 1; k < 60; ++k) velocity += input(k)[0] / 30;
  EXPECT_NEAR(velocity, 0, 0.03);
  EXPECT_TRUE(input(60).isZero());
}

TEST(SteeringController, BrakesWithinTheLimitsHoweverLongItTakes) {
  CameraState x = at_rest();
  x.segment<3>(7) << 0.9, 0, 0;
  Estimate estimate = tracking(x);
  ControlSettings settings;
  settings.max_acceleration_m_s2 = 0.5;
  SteeringController controller({free_camera_control(settings)});
  const auto input = [&](int k) {
    return input_of(command_of(controller.act(estimate, {}, {}, {k, k / 30.0, 1 / 30.0}), 0), 6)[0];
  };
  input(0);
  estimate.status.state = TrackingState::lost;
  double velocity = 0.9;
  for (int k = 1; k < 60; ++k) {
    EXPECT_GE(input(k), -0.5 - 1e-12);
    velocity += input(k) / 30;
  }
  EXPECT_NEAR(velocity, 0, 0.03);
}

TEST(SteeringController, DoesNotMoveAFreeCameraBeforeTheFirstDecision) {
  CameraState away = at_rest();
  away.head<3>() << 5, 5, 5;
  SteeringController controller({free_camera_control({})});
  Goal undecided;
  undecided.bodies.resize(1);
  EXPECT_TRUE(input_of(command_of(controller.act(tracking(away), undecided, {}, {0, 0, 0}), 0), 6).isZero());
}

TEST(SteeringController, SwingsTheGazeWhereTheGoalLeavesItFree) {
  const Estimate estimate = tracking(at_rest());
  ControlSettings settings;
  settings.gaze_amplitude_rad = 0.5;
  SteeringController controller({free_camera_control(settings)});
  Goal goal;
  goal.bodies.resize(1);
  goal.bodies[0].end_t = 100;
  const auto gaze = [&](double t) {
    return (*controller.act(estimate, goal, {}, {1, t, 0.1}).bodies.at(0).reference)[3];
  };
  EXPECT_NEAR(gaze(0), 0, 1e-12);
  EXPECT_NEAR(gaze(settings.gaze_period_s / 4), 0.5, 1e-12);
  goal.bodies[0].heading_rad = 1.2;
  EXPECT_NEAR(gaze(1), 1.2, 1e-12);
}

/// The operator sees the goal; the operator's motion is not a command.
TEST(SteeringController, DisplaysTheGoalToAnOperatorAndCommandsNothing) {
  CameraState moving = at_rest();
  moving.segment<3>(7) << 0.4, 0, 0;
  SteeringController controller({free_camera_control({}, true)});
  Goal goal;
  BodyGoal& own = goal.bodies.emplace_back();
  own.decided = true;
  own.to = {0, 0.3, 0};
  own.end_t = 1;
  EXPECT_TRUE(controller.act({}, goal, {}, {0, 0, 0}).bodies.empty()) << "not started";
  Estimate estimate = tracking(moving);
  BodyCommand command = controller.act(estimate, goal, {}, {1, 0.1, 0.1}).bodies.at(0);
  EXPECT_TRUE(command.operator_controlled);
  EXPECT_EQ(command.input.size(), 0);
  ASSERT_TRUE(command.shown);
  EXPECT_EQ(command.shown->segment.to, own.to);
  EXPECT_EQ(command.shown->segment.end_t, 1);
  EXPECT_TRUE(command.shown->is_new);
  EXPECT_FALSE(command.shown->gaze);
  own.decided = false;
  own.heading_rad = 0.5;
  command = controller.act(estimate, goal, {}, {2, 0.2, 0.1}).bodies.at(0);
  EXPECT_FALSE(command.shown->is_new);
  EXPECT_EQ(command.shown->gaze->rad, 0.5);
  estimate.status.state = TrackingState::lost;
  command = controller.act(estimate, goal, {}, {3, 0.3, 0.1}).bodies.at(0);
  EXPECT_TRUE(command.operator_controlled && !command.shown) << "come to rest";
  EXPECT_EQ(command.input.size(), 0);
}

/// A camera whose gaze and rates are those of a reference that turns and rises needs no angular acceleration.
TEST(FlySegment, TurnsAtTheRatesOfARaisedGaze) {
  const double elevation = 0.6, turn_rad_s = 0.3, rise_rad_s = 0.2, dt = 1e-6;
  const Eigen::Vector4d now = gaze_at(1, elevation),
                        later = gaze_at(1 + turn_rad_s * dt, elevation + rise_rad_s * dt);
  CameraState x = CameraState::Zero();
  x.segment<4>(3) = now;
  x.tail<3>() = quaternion_log(quaternion_product<double>(quaternion_conjugate(now), later)) / dt;
  const auto input = fly_segment(x, {{0, 0, 0}, {0, 0, 0}, 0, 1}, {1, turn_rad_s, elevation, rise_rad_s}, 0.5,
                                 ControlSettings{});
  EXPECT_NEAR(input.tail<3>().norm(), 0, 1e-5);
}

}  // namespace
}  // namespace incognita
