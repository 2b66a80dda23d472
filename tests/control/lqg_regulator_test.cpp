// Regulation to a goal: (5.2), (5.6), and the loop of Figure 5.5.
#include "incognita/control/lqg_regulator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/control/feedback_linearization.hpp"
#include "incognita/math/random.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::message_of;
using Pose = planar::Pose<double>;

TEST(Regulate, BringsADoubleIntegratorToItsGoalWithinItsLimit) {
  Matrix2d F;
  F << 1, 0.1, 0, 1;
  const MatrixXd G = Vector2d(0.005, 0.1);
  const RegulatorWeights weights{MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1)};
  VectorXd x = Vector2d(-3, 0);
  const VectorXd goal = Vector2d(2, 0), largest = VectorXd::Constant(1, 0.7);
  for (int k = 0; k < 300; ++k) {
    const Regulation step = regulate(F, G, x, goal, weights, largest);
    ASSERT_EQ(step.gain.outcome, RegulatorOutcome::converged);
    EXPECT_LE(std::abs(step.u[0]), 0.7);
    EXPECT_TRUE(step.saturated || k > 0);
    x = F * x + G * step.u;
  }
  EXPECT_LT((x - goal).norm(), 1e-6);
}

TEST(Regulate, HoldsAGoalThatNeedsAConstantInput) {
  const MatrixXd F = MatrixXd::Constant(1, 1, 0.9), G = MatrixXd::Constant(1, 1, 0.5),
                 one = MatrixXd::Ones(1, 1);
  VectorXd x = VectorXd::Zero(1);
  const VectorXd goal = VectorXd::Constant(1, 4);
  for (int k = 0; k < 200; ++k) x = F * x + G * regulate(F, G, x, goal, {one, one}, one * 10).u;
  EXPECT_NEAR(x[0], 4, 1e-9);
}

TEST(Regulate, RefusesWithReasons) {
  const Matrix2d I = Matrix2d::Identity();
  Matrix2d F;
  F << 1, 0.1, 0, 1;
  const MatrixXd G = Vector2d(0.005, 0.1), one = MatrixXd::Ones(1, 1);
  const VectorXd x = Vector2d(1, 1), largest = VectorXd::Ones(1);
  const auto complaint = [&](const VectorXd& estimate, const VectorXd& goal, const VectorXd& limit) {
    return message_of<std::invalid_argument>([&] { regulate(F, G, estimate, goal, {I, one}, limit); });
  };
  EXPECT_HAS(complaint(x, Vector2d(0, 1), largest), "no constant input holds the goal");
  EXPECT_HAS(complaint(VectorXd::Ones(3), x, largest), "x_hat is 3x1, not 2x1");
  EXPECT_HAS(complaint(x, VectorXd::Ones(1), largest), "the goal is 1x1, not 2x1");
  EXPECT_HAS(complaint(x, Vector2d(1, 0), -largest), "must be positive");
  EXPECT_HAS(complaint(Vector2d(NAN, 0), Vector2d(1, 0), largest), "not finite");
  const Regulation stuck = regulate(I, Vector2d(1, 0), x, Vector2d(0, 0), {I, one}, largest);
  EXPECT_EQ(stuck.gain.outcome, RegulatorOutcome::not_stabilizable);
  EXPECT_TRUE(stuck.u.isZero());
}

Pose hold(const DifferentialDrive& body, Pose pose, const Vector2d& input, double hold_s) {
  for (int i = 0; i < 100; ++i) pose = body.f<double>(pose, input, hold_s / 100);
  return pose;
}

TEST(PlanarRegulator, DrivesFromStartToGoal) {  // Example 5.1: from (-7, 0) to (10, 10)
  for (const double heading : {0.0, 1.5, 3.1, -2.0}) {
    PlanarRegulatorSettings settings;
    settings.body = {0.3, 0.1};
    const PlanarRegulator regulator(settings);
    Pose pose(-7, 0, heading);
    const Vector2d goal(10, 10);
    bool was_saturated = false;
    double last = (pose.head<2>() - goal).norm();
    for (int k = 0; k < 1000; ++k) {
      const PlanarRegulation step = regulator.act(pose, goal);
      was_saturated = was_saturated || step.command.saturated;
      EXPECT_LE(std::abs(step.command.speed_m_s), settings.limits.max_speed_m_s);
      EXPECT_LE(std::abs(step.command.turn_rate_rad_s), settings.limits.max_turn_rate_rad_s);
      pose = hold(settings.body, pose, step.command.input(), settings.period_s);
      last = (pose.head<2>() - goal).norm();
    }
    EXPECT_TRUE(was_saturated);
    EXPECT_LT(last, 0.01) << "from heading " << heading;
  }
}

TEST(PlanarRegulator, PositionIsStableAndTheHeadingUncontrolled) {
  RandomStream random(1, "poses");
  for (int i = 0; i < 200; ++i) {
    PlanarRegulatorSettings settings;
    settings.body = {random.uniform(0.1, 2), random.uniform(-1, 1)};
    const Pose pose(random.normal(), random.normal(), random.uniform(-4, 4));
    const Matrix2d L = PlanarRegulator(settings).act(pose, {3, 4}).L;
    const Matrix2d G = point_velocity_by_input(settings.body, pose[2]) * settings.period_s;
    EXPECT_TRUE(is_stabilizing(Matrix2d::Identity(), G, L));
    const Eigen::Matrix3d at_rest = planar_closed_loop(settings.body, pose, {0, 0}, settings.period_s, L);
    EXPECT_NEAR(stability_of(at_rest).spectral_radius, 1, 1e-12) << "the heading stays where it is";
    const Eigen::Vector3cd modes = stability_of(at_rest).eigenvalues;
    EXPECT_EQ((modes.cwiseAbs().array() < 1 - 1e-3).count(), 2);
  }
}

/// The linear closed loop is the derivative of the simulated one.
TEST(PlanarRegulator, ClosedLoopIsTheDerivativeOfThePlantUnderAFixedGain) {
  const DifferentialDrive body{0.4, 0.2};
  const Pose pose(1, 2, 0.6);
  const Vector2d goal(3, 1);
  const double dt = 0.1, h = 1e-6;
  const Matrix2d L = PlanarRegulator({.body = body, .period_s = dt}).act(pose, goal).L;
  const auto next = [&](const Pose& at) {
    return body.f<double>(at, Vector2d(-L * (at.head<2>() - goal)), dt);
  };
  const Vector2d u = -L * (pose.head<2>() - goal);
  const Eigen::Matrix3d A = planar_closed_loop(body, pose, u, dt, L);
  for (int i = 0; i < 3; ++i) {
    const Pose step = h * Pose::Unit(i);
    EXPECT_LE(((next(pose + step) - next(pose - step)) / (2 * h) - A.col(i)).norm(), 1e-8);
  }
}

TEST(PlanarRegulator, RefusesSettingsWithoutASolution) {
  const auto complaint = [](auto change) {
    PlanarRegulatorSettings settings;
    change(settings);
    return message_of<std::invalid_argument>([&] { PlanarRegulator regulator(settings); });
  };
  using S = PlanarRegulatorSettings;
  EXPECT_EQ(complaint([](S&) {}), "(none)");
  EXPECT_HAS(complaint([](S& s) { s.body.forward_m = 0; }), "no gain stabilizes");
  EXPECT_HAS(complaint([](S& s) { s.Q1(1, 1) = 0; }), "costs nothing");
  EXPECT_HAS(complaint([](S& s) { s.Q2(1, 1) = 0; }), "Q2 has the eigenvalue 0");
  EXPECT_HAS(complaint([](S& s) { s.period_s = 0; }), "the period must be positive");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_speed_m_s = 0; }), "speed limit");
  EXPECT_HAS(message_of<std::invalid_argument>([] {
               PlanarRegulator({}).act({0, 0, NAN}, {0, 0});
             }),
             "not finite");
}

}  // namespace
}  // namespace incognita
