// Feedback linearization of planar vehicles: exact, convergent with held commands, within limits, or refused.
#include "incognita/control/feedback_linearization.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/control/held_command.hpp"
#include "incognita/control/paths/reference_path.hpp"
#include "incognita/math/random.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::message_of;
using Pose = planar::Pose<double>;

/// The continuous vehicle with a held input: a thousand steps of (3.16).
Pose drive(const DifferentialDrive& body, Pose pose, const Vector2d& input, double hold_s) {
  for (int i = 0; i < 1000; ++i) pose = body.f<double>(pose, input, hold_s / 1000);
  return pose;
}

Reference still_at(double x, double y) { return {.position = {x, y, 0}}; }

DifferentialDrive random_body(RandomStream& random) {
  return {(random.below(2) ? 1 : -1) * random.uniform(0.05, 2), random.uniform(-1, 1)};
}

TEST(FeedbackLinearization, MovesTheControlPointAtTheDesiredVelocityForEveryHeading) {
  RandomStream random(1, "headings");
  for (int i = 0; i < 1000; ++i) {
    const DifferentialDrive body = random_body(random);
    const Pose pose(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-4, 4));
    const Vector2d desired(random.normal(), random.normal());
    const Vector2d u = input_for_velocity(body, pose[2], desired);
    EXPECT_LE((point_velocity_by_input(body, pose[2]) * u - desired).norm(), 1e-12);
    constexpr double h = 1e-6;  // the model's own motion
    EXPECT_LE(((body.f<double>(pose, u, h) - pose).head<2>() / h - desired).norm(), 1e-7);
    EXPECT_NEAR(point_velocity_by_input(body, pose[2]).determinant(), body.forward_m, 1e-12);
  }
}

TEST(FeedbackLinearization, EqualsTheThesisMatrixForAPointOnTheAxis) {  // (5.13)
  const double heading = 0.7, l = 0.4;
  Matrix2d Q_r;
  Q_r << std::cos(heading), -l * std::sin(heading), std::sin(heading), l * std::cos(heading);
  EXPECT_TRUE(point_velocity_by_input({l, 0}, heading).isApprox(Q_r, 1e-15));
}

/// Distances to a fixed goal over a run with held commands.
struct Approach {
  double first = 0, last = 0;
  bool nearer_each_time = true, within_limits = true;
};

Approach run_to_origin(const LinearizationSettings& settings, Pose pose, int commands) {
  const FeedbackLinearization law(settings);
  Approach run{pose.head<2>().norm(), 0, true, true};
  double before = run.first;
  for (int k = 0; k < commands; ++k) {
    const PlanarCommand command = law.act(pose, still_at(0, 0));
    run.within_limits = run.within_limits && std::abs(command.speed_m_s) <= settings.limits.max_speed_m_s &&
                        std::abs(command.turn_rate_rad_s) <= settings.limits.max_turn_rate_rad_s;
    pose = drive(settings.body, pose, command.input(), settings.hold_s);
    run.last = pose.head<2>().norm();
    run.nearer_each_time =
        run.nearer_each_time && run.last < before * (1 + 1e-4) + 1e-6;  // error of the thousand steps
    before = run.last;
  }
  return run;
}

TEST(FeedbackLinearization, DistanceFallsAtEveryHeldCommandUpToTheBound) {
  RandomStream random(2, "holds");
  for (int i = 0; i < 100; ++i) {
    LinearizationSettings settings;
    settings.body = random_body(random);
    settings.hold_s = random.uniform(0.02, 0.5);
    settings.limits = {random.uniform(0.3, 3), random.uniform(0.2, 3)};
    const double bound = gain_bound_per_s(settings.limits.max_turn_rate_rad_s, settings.hold_s);
    settings.gain_per_s = random.uniform(0.1, 0.99) * bound * Matrix2d::Identity();
    const Pose start(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-4, 4));
    const Approach run = run_to_origin(settings, start, 300);
    EXPECT_TRUE(run.nearer_each_time);
    EXPECT_TRUE(run.within_limits);
    EXPECT_LT(run.last, run.first);
  }
}

TEST(FeedbackLinearization, ConvergesFromAnyHeading) {
  LinearizationSettings settings;
  settings.gain_per_s = 2 * Matrix2d::Identity();
  settings.limits = {1, 2};
  for (double heading = -3; heading <= 3; heading += 0.5)
    EXPECT_LT(run_to_origin(settings, {3, -2, heading}, 300).last, 1e-4);
}

TEST(FeedbackLinearization, UnequalGainsHaveTheirOwnBound) {
  RandomStream random(3, "gains");
  int accepted = 0;
  for (int i = 0; i < 400; ++i) {
    LinearizationSettings settings;
    settings.hold_s = 0.3;
    settings.limits = {5, 2};
    const Matrix2d R = Eigen::Rotation2Dd(random.uniform(-3, 3)).toRotationMatrix();
    const Vector2d k(random.uniform(0.2, 6.6), random.uniform(0.2, 6.6));
    settings.gain_per_s = R * k.asDiagonal() * R.transpose();
    settings.gain_per_s(1, 0) = settings.gain_per_s(0, 1);
    if (gain_refusal(settings.gain_per_s, settings.hold_s, settings.limits.max_turn_rate_rad_s)) continue;
    ++accepted;
    const Pose start(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-4, 4));
    EXPECT_TRUE(run_to_origin(settings, start, 60).nearer_each_time) << k.transpose();
  }
  EXPECT_GT(accepted, 50);
}

/// The exact motion under a held command, from which the bound follows.
double ratio_of_distances(double k, double hold_s, double turn_rate) {
  const DifferentialDrive body{0.5, 0};
  // A goal for which -k e has that turn rate, with a forward part, so that it lies in every direction
  double worst = 0;
  for (double forward = -3; forward <= 3; forward += 0.05) {
    const Vector2d w(forward, turn_rate * body.forward_m);
    const Pose start(-w.x() / k, -w.y() / k, 0);
    const Pose end = drive(body, start, input_for_velocity(body, 0, w), hold_s);
    worst = std::max(worst, end.head<2>().norm() / start.head<2>().norm());
  }
  return worst;
}

TEST(HeldCommand, BoundIsWhereTheDistanceBeginsToGrow) {
  for (const double turn_rate : {0.5, 2.0, 4.0})
    for (const double hold_s : {0.1, 0.5}) {
      const double bound = gain_bound_per_s(turn_rate, hold_s);
      EXPECT_LT(ratio_of_distances(0.98 * bound, hold_s, turn_rate), 1);
      EXPECT_GT(ratio_of_distances(1.02 * bound, hold_s, turn_rate), 1);
    }
  EXPECT_NEAR(gain_bound_per_s(1e-9, 0.1), 20, 1e-9) << "the bound of the model";
  EXPECT_NEAR(gain_bound_per_s(std::numbers::pi / 0.1, 0.1), 0, 1e-9);
}

/// K dt = 1.5 with l = 0.1 m satisfies |1 - K dt| < 1, and still the vehicle diverges.
TEST(HeldCommand, VehicleWithoutATurnRateLimitDiverges) {
  const DifferentialDrive body{0.1, 0};
  const double hold_s = 0.1;
  const Matrix2d K = 15 * Matrix2d::Identity();
  Pose pose(0, 0.3, 0);
  double farthest = 0;
  for (int k = 0; k < 200; ++k) {
    const Vector2d desired = velocity_towards(still_at(0, 0), K, pose.head<2>());
    pose = drive(body, pose, input_for_velocity(body, pose[2], desired), hold_s);
    farthest = std::max(farthest, pose.head<2>().norm());
  }
  EXPECT_GT(farthest, 0.3 * 1.2);
  LinearizationSettings settings{.body = body, .gain_per_s = K, .hold_s = hold_s, .limits = {1, 20}};
  EXPECT_HAS(message_of<std::invalid_argument>([&] { FeedbackLinearization law(settings); }),
             "may drive the vehicle away while its body turns at 20 rad/s");
  settings.limits.max_turn_rate_rad_s = 5;
  EXPECT_TRUE(run_to_origin(settings, {0, 0.3, 0}, 300).nearer_each_time);
}

TEST(FeedbackLinearization, FollowsACircle) {  // Example 5.2: 7 m, 5 deg/s
  const LinearizationSettings settings{
      .body = {0.3, 0.1}, .gain_per_s = Matrix2d::Identity(), .hold_s = 0.1, .limits = {1, 1}};
  const FeedbackLinearization law(settings);
  const Path circle = CirclePath{.center = {0, 0, 0}, .radius_m = 7, .rate_rad_s = radians(5)};
  Pose pose(-7, 0, 0);
  double worst_late = 0;
  PlanarCommand command;
  for (int k = 0; k < 1200; ++k) {
    const Reference reference = at(circle, 0.1 * k);
    if (k > 600) worst_late = std::max(worst_late, (pose.head<2>() - reference.position.head<2>()).norm());
    command = law.act(pose, reference);
    EXPECT_TRUE(command.saturated || k >= 5);
    pose = drive(settings.body, pose, command.input(), settings.hold_s);
  }
  EXPECT_LT(worst_late, 0.005);
  EXPECT_NEAR(command.turn_rate_rad_s, radians(5), 1e-3);
  EXPECT_NEAR(command.speed_m_s, 0.61, 0.02);  // "around a steady-state value 0.6"
}

TEST(FeedbackLinearization, SaturationKeepsTheDirectionOfTheControlPoint) {
  RandomStream random(4, "limits");
  for (int i = 0; i < 500; ++i) {
    LinearizationSettings settings;
    settings.body = random_body(random);
    settings.limits = {random.uniform(0.1, 1), random.uniform(0.1, 1)};
    const Pose pose(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-4, 4));
    const PlanarCommand command = FeedbackLinearization(settings).act(pose, still_at(0, 0));
    const Vector2d moves = point_velocity_by_input(settings.body, pose[2]) * command.input();
    const Vector2d desired = -pose.head<2>();
    EXPECT_NEAR(moves.normalized().dot(desired.normalized()), 1, 1e-12);
    EXPECT_EQ(command.saturated, moves.norm() < desired.norm() * (1 - 1e-12));
  }
}

TEST(FeedbackLinearization, TeamEqualsIndependentVehicles) {
  RandomStream random(5, "team");
  std::vector<FeedbackLinearization> team;
  std::vector<Pose> poses;
  std::vector<Reference> references;
  for (int i = 0; i < 3; ++i) {
    LinearizationSettings settings;
    settings.body = random_body(random);
    team.emplace_back(settings);
    poses.emplace_back(random.normal(), random.normal(), random.normal());
    references.push_back(still_at(random.normal(), random.normal()));
  }
  const std::vector<PlanarCommand> commands = act_together(team, poses, references);
  ASSERT_EQ(commands.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(commands[i].input(), team[i].act(poses[i], references[i]).input());
  poses.pop_back();
  EXPECT_EQ(message_of<std::invalid_argument>([&] { act_together(team, poses, references); }),
            "3 vehicles, 2 estimates and 3 references");
}

TEST(FeedbackLinearization, RefusesInvalidSettings) {
  const auto complaint = [](auto change) {
    LinearizationSettings settings;
    change(settings);
    return message_of<std::invalid_argument>([&] { FeedbackLinearization law(settings); });
  };
  using S = LinearizationSettings;
  const Matrix2d I = Matrix2d::Identity();
  EXPECT_EQ(complaint([](S&) {}), "(none)");
  EXPECT_HAS(complaint([](S& s) { s.body.forward_m = 0; }), "must be before or behind the axle");
  EXPECT_HAS(complaint([](S& s) { s.body.left_m = NAN; }), "control point");
  EXPECT_HAS(complaint([](S& s) { s.gain_per_s = Eigen::Matrix3d::Identity(); }), "the gain is 3x3, not 2x2");
  EXPECT_HAS(complaint([&](S& s) { s.gain_per_s = -I; }), "eigenvalue -1 1/s, which is not positive");
  EXPECT_HAS(complaint([&](S& s) { s.gain_per_s = 0 * I; }), "which is not positive");
  EXPECT_HAS(complaint([](S& s) { s.gain_per_s(0, 1) = 0.5; }), "the gain is not symmetric");
  EXPECT_HAS(complaint([](S& s) { s.gain_per_s(0, 0) = NAN; }), "not finite");
  EXPECT_HAS(complaint([&](S& s) { s.gain_per_s = 20 * I; }), "it must be less than 20 1/s");
  EXPECT_HAS(complaint([&](S& s) { s.gain_per_s = 19.99 * I; }), "may drive the vehicle away");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_turn_rate_rad_s = 32; }), "half a turn or more");
  EXPECT_HAS(complaint([](S& s) { s.hold_s = 0; }), "a command held for 0 s");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_speed_m_s = 0; }), "speed limit must be positive");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_turn_rate_rad_s = std::numeric_limits<double>::infinity(); }),
             "turn rate limit must be positive and finite");
  const FeedbackLinearization law(LinearizationSettings{});
  EXPECT_HAS(message_of<std::invalid_argument>([&] { law.act({NAN, 0, 0}, still_at(0, 0)); }), "not finite");
}

}  // namespace
}  // namespace incognita
