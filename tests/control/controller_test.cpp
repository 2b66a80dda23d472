#include <gtest/gtest.h>

#include "incognita/control/camera_controller.hpp"
#include "incognita/control/reference.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/models/heading.hpp"

namespace incognita {
namespace {

TEST(MinimumJerk, GoesFromRestToRestAndItsDerivativesAreItsOwn) {
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

TEST(TrackReference, BringsTheConstantVelocityModelToThePlaceAndGaze) {  // thesis (5.29) on (5.24)
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
  const CameraState wanted = at_rest();
  FreeCameraMotion::chart.minus({x.data(), 13}, {wanted.data(), 13}, {error.data(), 12});
  EXPECT_LT(error.norm(), 1e-4);
}

TEST(TrackReference, NeverAsksForMoreThanTheBodyCanDo) {
  CameraState x = at_rest();
  x.head<3>() << 100, -100, 0;
  ControlSettings settings;
  settings.max_acceleration_m_s2 = 2;
  const Command u = track_reference(x, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, level_gaze(3), {0, 0, 0}, settings);
  EXPECT_DOUBLE_EQ(u.linear_acceleration.x(), -2);
  EXPECT_DOUBLE_EQ(u.linear_acceleration.y(), 2);
  EXPECT_LE(u.angular_acceleration.cwiseAbs().maxCoeff(), settings.max_angular_acceleration_rad_s2);
}

TEST(CameraController, BrakesFromTheLastKnownMotionWhenLostThenDoesNothing) {
  Estimate estimate;
  CameraState x = at_rest();
  x.segment<3>(7) << 0.4, 0, 0;
  estimate.camera =
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

/// An estimate that is wrong, or jumps, moves nobody's hand.
TEST(CameraController, APersonGoesByWhatTheHandFeels) {
  PersonSettings person;
  person.holds = true;
  person.delay_s = person.sigma_way_ratio = person.wrong = 0;
  CameraController controller({}, person);
  Estimate estimate;
  CameraState believed = at_rest();
  believed.x() += 0.5;
  estimate.camera =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, believed, FreeCameraMotion::Jacobian::Identity());
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  Goal goal;
  goal.decided = true;
  goal.from = believed.head<3>();
  goal.to = goal.from + Eigen::Vector3d(0, 0.3, 0);
  goal.end_t = 1;
  CameraState hand = at_rest();
  Observation seen;
  for (int k = 0; k <= 45; ++k) {
    seen.felt.assign(1, hand);
    const Command command = controller.act(estimate, goal, seen, {k, k / 30.0, k == 0 ? 0 : 1 / 30.0});
    EXPECT_TRUE(command.by_hand);
    EXPECT_LT(command.linear_acceleration.norm(), 2) << "0.3 m in a second by the least jerk";
    hand = FreeCameraMotion{}.f<double>(hand, command.as_input(), 1 / 30.0);
    goal.decided = false;
  }
  EXPECT_NEAR((hand.head<3>() - at_rest().head<3>() - Eigen::Vector3d(0, 0.3, 0)).norm(), 0, 0.02);
}

/// Who is told nothing more does not carry on: the hand comes to rest from what it last felt, and what was
/// shown before is not done afterwards.
TEST(CameraController, AHandStopsWhenItsFilterIsLost) {
  PersonSettings person;
  person.holds = true;
  person.delay_s = 1;
  person.sigma_way_ratio = person.wrong = 0;
  CameraController controller({}, person);
  Estimate estimate;
  estimate.camera =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, at_rest(), FreeCameraMotion::Jacobian::Identity());
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  Goal goal;
  goal.decided = true;
  goal.to = Eigen::Vector3d(0.3, 0, 0);
  goal.end_t = 1;
  CameraState hand = at_rest();
  hand.segment<3>(7) << 0.4, -0.2, 0;
  Observation seen;
  const auto step = [&](int k) {
    seen.felt.assign(1, hand);
    const Command command = controller.act(estimate, goal, seen, {k, k / 30.0, k == 0 ? 0 : 1 / 30.0});
    EXPECT_TRUE(command.by_hand) << k;
    hand = FreeCameraMotion{}.f<double>(hand, command.as_input(), 1 / 30.0);
    goal.decided = false;
  };
  step(0);
  const double before = hand.segment<3>(7).norm();
  ASSERT_GT(before, 0.2);
  estimate.status.state = TrackingState::lost;
  for (int k = 1; k < 45; ++k) step(k);
  EXPECT_LT(hand.segment<3>(7).norm(), 0.05 * before);
  estimate.status.state = TrackingState::tracking;
  const Eigen::Vector3d rest = hand.head<3>();
  for (int k = 45; k < 120; ++k) step(k);
  EXPECT_LT((hand.head<3>() - rest).norm(), 0.05) << "what was shown before it was lost is forgotten";
}

}  // namespace
}  // namespace incognita
