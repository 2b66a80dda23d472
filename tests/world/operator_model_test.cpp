// The operator model: delay, imprecision, errors, and determinism for a seed.
#include "incognita/world/operator_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "incognita/control/fly_segment.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

const Eigen::Vector3d here(1, 2, 1.2);

OperatorSettings exact() {
  OperatorSettings s;
  s.holds = true;
  s.delay_s = s.sigma_way_ratio = 0;
  return s;
}

/// A command of one second; `is_new`: whether it is displayed for the first time.
UserCommand shown_at(double t, const Eigen::Vector3d& displacement, bool is_new = true) {
  return {{here, here + displacement, t, t + 1}, is_new, {}};
}

TEST(OperatorModel, AppliesTheDisplacementFromTheCamerasPosition) {
  OperatorModel model(exact(), 1, "operator");
  const Eigen::Vector3d at(5, 5, 1);
  const Segment doing = model.follow(shown_at(3, {0.3, 0, 0}), at, 3);
  EXPECT_EQ(doing.from, at);
  EXPECT_NEAR((doing.to - at - Eigen::Vector3d(0.3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(doing.start_t, 3);
  EXPECT_EQ(doing.end_t, 4);
}

TEST(OperatorModel, WaitsForTheDelayAndThenAppliesTheWholeCommand) {
  OperatorSettings s = exact();
  s.delay_s = 0.4;
  OperatorModel model(s, 1, "operator");
  const Eigen::Vector3d shown(0, 0.3, 0);
  for (int i = 0; i < 8; ++i) {
    const Segment doing = model.follow(shown_at(0, shown, i == 0), here, i * 0.05);
    EXPECT_EQ(doing.from, doing.to) << "still standing after " << i * 0.05 << " s";
  }
  const Segment doing = model.follow(shown_at(0, shown, false), here, 0.4);
  EXPECT_NEAR((doing.to - here - Eigen::Vector3d(0, 0.3, 0)).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(doing.end_t, 1.4);
}

TEST(OperatorModel, ADelayBeyondThePeriodQueuesCommands) {
  OperatorSettings s = exact();
  s.delay_s = 1.5;
  OperatorModel model(s, 1, "operator");
  model.follow(shown_at(0, {0.3, 0, 0}), here, 0);
  model.follow(shown_at(1, {0, 0, 0.3}), here, 1);
  EXPECT_NEAR(model.follow(shown_at(1, {0, 0, 0.3}, false), here, 1.5).to.x(), here.x() + 0.3, 1e-12);
  EXPECT_NEAR(model.follow(shown_at(1, {0, 0, 0.3}, false), here, 2.5).to.z(), here.z() + 0.3, 1e-12);
}

/// A wrong action keeps only the length of the right one: the five other directions are equally likely.
TEST(OperatorModel, WrongActionsHaveTheStatedRateAndTheSameLength) {
  OperatorSettings s = exact();
  s.wrong = 0.25;
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(0.3, 0, 0), Eigen::Vector3d(0, 0, -0.3)}) {
    OperatorModel model(s, 7, "operator");
    int wrong = 0, back = 0;
    constexpr int times = 4000;
    for (int i = 0; i < times; ++i) {
      const Segment doing = model.follow(shown_at(i, way), here, i);
      const Eigen::Vector3d displacement = doing.to - doing.from;
      EXPECT_NEAR(displacement.norm(), 0.3, 1e-12);
      wrong += (displacement - way).norm() > 1e-9;
      back += (displacement + way).norm() < 1e-9;
    }
    EXPECT_NEAR(wrong, times * 0.25, 4 * std::sqrt(times * 0.25 * 0.75));
    EXPECT_NEAR(back, times * 0.05, 4 * std::sqrt(times * 0.05 * 0.95));
  }
}

TEST(OperatorModel, StayIsNeverWrong) {
  OperatorSettings s = exact();
  s.wrong = 1;
  OperatorModel model(s, 1, "operator");
  const Segment doing = model.follow(shown_at(0, {0, 0, 0}), here, 0);
  EXPECT_EQ(doing.from, doing.to);
}

TEST(OperatorModel, IsDeterministicForASeed) {
  OperatorSettings s = exact();
  s.sigma_way_ratio = 0.2;
  const auto displacement = [&](std::uint64_t seed) {
    OperatorModel model(s, seed, "operator");
    std::vector<double> ways;
    for (int i = 0; i < 5; ++i) {
      const Segment doing = model.follow(shown_at(i, {0.3, 0, 0}), here, i);
      ways.push_back((doing.to - doing.from).norm());
    }
    return ways;
  };
  EXPECT_EQ(displacement(3), displacement(3));
  EXPECT_NE(displacement(3), displacement(4));
}

TEST(OperatorModel, RefusesInvalidSettings) {
  OperatorSettings s = exact();
  s.wrong = 1.5;
  EXPECT_THROW(OperatorModel(s, 1, "operator"), std::invalid_argument);
  s = exact();
  s.delay_s = -1;
  EXPECT_THROW(OperatorModel(s, 1, "operator"), std::invalid_argument);
}

TEST(OperatorModel, ForgetDiscardsPendingCommands) {
  OperatorSettings s = exact();
  s.delay_s = 0.5;
  OperatorModel model(s, 1, "operator");
  const Eigen::Vector3d there(4, 5, 6);
  model.follow(shown_at(0, {1, 0, 0}), {0, 0, 0}, 0);
  model.forget();
  const Segment after = model.follow(shown_at(0, {1, 0, 0}, false), there, 2);
  EXPECT_EQ(after.from, there);
  EXPECT_EQ(after.to, there);
}

CameraState at_rest() {
  CameraState x = CameraState::Zero();
  x.head<3>() = here;
  x.segment<4>(3) = level_gaze(0);
  return x;
}

OperatorActuator actuator_of(const OperatorSettings& settings, const GazeSwing& swing = {}) {
  const auto motion = [](const CameraState& state, const Segment& segment, const Heading& gaze, double t) {
    return fly_segment(state, segment, gaze, t, {});
  };
  return {OperatorModel(settings, 1, "operator"), motion, swing};
}

/// A camera held by an operator, in ticks of 1/30 s.
struct Held {
  OperatorActuator actuator;
  CameraState camera = at_rest();
  int ticks = 0;

  Eigen::Matrix<double, 6, 1> step(const BodyCommand& command) {
    const auto input = actuator.move(command, camera, ticks++ / 30.0);
    camera = FreeCameraMotion{}.f<double>(camera, input, 1 / 30.0);
    return input;
  }
};

BodyCommand to_operator(const UserCommand& shown) {
  BodyCommand command;
  command.operator_controlled = true;
  command.shown = shown;
  return command;
}

/// The motion begins at the true position, whatever position the display assumes.
TEST(OperatorActuator, MovesTheCameraFromItsTruePosition) {
  Held held{actuator_of(exact())};
  UserCommand shown = shown_at(0, {0, 0.3, 0});
  shown.segment.from.x() += 0.5, shown.segment.to.x() += 0.5;
  for (int k = 0; k <= 45; ++k) {
    EXPECT_LT(held.step(to_operator(shown)).head<3>().norm(), 2) << "0.3 m in a second with the least jerk";
    shown.is_new = false;
  }
  EXPECT_NEAR((held.camera.head<3>() - here - Eigen::Vector3d(0, 0.3, 0)).norm(), 0, 0.02);
}

TEST(OperatorActuator, StopsWithoutADisplayedCommandAndForgetsTheLastOne) {
  OperatorSettings late = exact();
  late.delay_s = 1;
  Held held{actuator_of(late)};
  held.camera.segment<3>(7) << 0.4, -0.2, 0;
  UserCommand shown = shown_at(0, {0.3, 0, 0});
  held.step(to_operator(shown));
  const double before = held.camera.segment<3>(7).norm();
  ASSERT_GT(before, 0.2);
  BodyCommand blank;
  blank.operator_controlled = true;
  for (int k = 1; k < 45; ++k) held.step(blank);
  EXPECT_LT(held.camera.segment<3>(7).norm(), 0.05 * before);
  const Eigen::Vector3d rest = held.camera.head<3>();
  shown.is_new = false;
  for (int k = 45; k < 120; ++k) held.step(to_operator(shown));
  EXPECT_LT((held.camera.head<3>() - rest).norm(), 0.05);
}

TEST(OperatorActuator, DoesNotMoveACameraThatIsNotHandHeld) {
  Held held{actuator_of(exact())};
  held.camera.tail<6>().setConstant(0.1);
  EXPECT_TRUE(held.step({}).isZero());
}

TEST(OperatorActuator, FollowsTheDisplayedGazeOrSwings) {
  UserCommand shown = shown_at(0, {0, 0, 0});
  Held free{actuator_of(exact(), {0.5, 4})}, guided = free;
  for (int k = 0; k <= 30; ++k) free.step(to_operator(shown));
  EXPECT_NEAR(heading_of(free_camera::orientation(free.camera)), 0.5, 0.1) << "after a quarter of a period";
  shown.gaze = {-0.3, 0};
  for (int k = 0; k <= 90; ++k) guided.step(to_operator(shown));
  EXPECT_NEAR(heading_of(free_camera::orientation(guided.camera)), -0.3, 0.01);
}

}  // namespace
}  // namespace incognita
