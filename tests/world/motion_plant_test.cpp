// The simulated motion of any vehicle: closed-form solutions, limits, and determinism for a seed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "incognita/math/angles.hpp"
#include "incognita/world/integrate.hpp"
#include "incognita/world/plant.hpp"
#include "tests/models/grounds.hpp"
#include "tests/models/registered.hpp"
#include "tests/scratch.hpp"
#include "tests/small_vectors.hpp"

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::message_of;
using testing::minus;
using testing::vec;

// Closed-form solutions

/// Pose of a body after its axle moved with speed v (m/s) and turn rate w (rad/s) for t seconds.
SmallVector on_circle(const DifferentialDrive& body, const SmallVector& x, double v, double w, double t) {
  const Vector2d lever(body.forward_m, body.left_m);
  const Vector2d axle = x.head<2>() - Eigen::Rotation2Dd(x[2]) * lever;
  const Vector2d center = axle + Eigen::Rotation2Dd(x[2]) * Vector2d(0, v / w);
  const double heading = x[2] + w * t;
  const Vector2d point = center + Eigen::Rotation2Dd(heading) * (lever - Vector2d(0, v / w));
  return vec({point.x(), point.y(), wrap_angle(heading)});
}

TEST(Integrate, ADifferentialDriveMovesOnACircle) {
  const SmallVector start = vec({1, -2, 3});
  for (const DifferentialDrive& body : {DifferentialDrive{0, 0}, DifferentialDrive{0.4, -0.2}})
    for (const double w : {0.7, -2.0})
      for (const double t : {0.01, 1.0, 30.0}) {
        const SmallVector end = integrate(body, start, vec({1.5, w}), t);
        const SmallVector off = minus(planar::pose_chart, end, on_circle(body, start, 1.5, w, t));
        EXPECT_LE(off.norm(), 1e-7) << w << " rad/s for " << t << " s";
        EXPECT_LE(std::abs(end[2]), std::numbers::pi);
      }
}

TEST(Integrate, ACarMovesOnTheCircleOfItsSteering) {
  AckermannCar car;
  car.body = {3.78, 0.5};
  const SmallVector start = vec({5, 1, -1});
  for (const double steering : {0.3, -0.5})
    for (const double t : {0.1, 20.0}) {
      // The measured wheel moves on its own radius, with the turn rate of the car
      const double radius = car.wheelbase_m / std::tan(steering), w = 2 / (radius - car.wheel_left_m);
      const SmallVector end = integrate(car, start, vec({2, steering}), t);
      const SmallVector off = minus(planar::pose_chart, end, on_circle(car.body, start, radius * w, w, t));
      EXPECT_LE(off.norm(), 1e-7) << steering << " rad for " << t << " s";
    }
}

TEST(Integrate, AFreeBodyMovesOnAParabolaAndSpinsUpAboutAnAxis) {
  const Vector3d v(1, -2, 0.5), f(0.3, 0.1, -9.81), axis = Vector3d(1, 2, -2) / 3;
  const double w = 0.8, a = -0.3;
  SmallVector start(13);
  start << 1, 2, 3, quaternion_exp<double>(Vector3d(0.3, -0.4, 0.5)), v, w * axis;
  SmallVector input(6);
  input << f, a * axis;
  for (const double t : {0.02, 1.0, 12.0}) {
    const SmallVector end = integrate(FreeCameraMotion{}, start, input, t);
    SmallVector wanted(13);
    wanted << start.head<3>() + v * t + f * t * t / 2,
        quaternion_product<double>(start.segment<4>(3),
                                   quaternion_exp<double>((w * t + a * t * t / 2) * axis)),
        v + f * t, (w + a * t) * axis;
    EXPECT_LE(minus(FreeCameraMotion::chart, end, wanted).norm(), 1e-7 * (1 + t * t)) << t << " s";
    EXPECT_NEAR(end.segment<4>(3).norm(), 1, 1e-14);
  }
}

TEST(Integrate, AVehicleOnALineMovesStraight) {
  EXPECT_NEAR(integrate(MonobotMotion{}, vec({3}), vec({-0.7}), 10)[0], -4, 1e-9);
}

TEST(Integrate, AVehicleOnASlopeMovesOnACircleInThatPlane) {
  const TerrainVehicle vehicle{grounds::steep_slope()};
  const SmallVector start = vec({1, 2, 0.5});
  const double v = 1.2, w = 0.6;
  const auto first = vehicle.pose(planar::Pose<double>(start));
  const Eigen::Matrix3d axes = rotation_matrix<double>(first.pose.world_from_body);
  for (const double t : {0.3, 7.0}) {
    const SmallVector end = integrate(vehicle, start, vec({v, w}), t);
    const Vector3d turned = v / w * (std::sin(w * t) * axes.col(0) + (1 - std::cos(w * t)) * axes.col(1));
    EXPECT_LE((pose_of(vehicle, end).position - first.pose.position - turned).norm(), 1e-7) << t << " s";
  }
}

TEST(Integrate, AVehicleOnUnevenGroundStaysOnItAtTheCommandedSpeed) {
  for (const Terrain& ground :
       {grounds::steep_waves(), grounds::gentle_waves(), grounds::small_height_map()}) {
    const AnyMotion vehicle = TerrainVehicle{ground};
    SmallVector x = vec({-3, 1, 0.4});
    const double v = 0.9, w = 0.5, dt = 1e-3;
    for (int k = 0; k < 4000; ++k) {
      const RigidPose before = pose_of(vehicle, x);
      x = integrate(vehicle, x, vec({v, w}), dt);
      const RigidPose after = pose_of(vehicle, x);
      ASSERT_NEAR(after.position.z(), (ground.at<double>(x[0], x[1]).height), 1e-12);
      // Displacement and rotation over a millisecond, in the axes at its middle
      const SmallVector middle = x - 0.5 * dt * rate_of(vehicle, x, vec({v, w}));
      const Eigen::Matrix3d axes = rotation_matrix<double>(pose_of(vehicle, middle).world_from_body);
      const Vector3d moved = axes.transpose() * (after.position - before.position) / dt;
      ASSERT_LE((moved - Vector3d(v, 0, 0)).norm(), 1e-4) << k;
      const Vector3d turned = quaternion_log<double>(
          quaternion_product<double>(quaternion_conjugate(before.world_from_body), after.world_from_body));
      ASSERT_NEAR(turned.z() / dt, w, 1e-4) << k;
    }
  }
}

// The plant

PlantSettings at_rest(const AnyMotion& motion) {
  const int errors = chart_of(motion).tangent(), inputs = inputs_of(motion);
  PlantSettings s{SmallVector::Zero(chart_of(motion).ambient()), SmallVector::Zero(errors),
                  SmallVector::Zero(inputs), SmallVector::Constant(inputs, -1),
                  SmallVector::Constant(inputs, 2)};
  s.start = at_rest(motion, Vector3d::Zero(), 0);
  for (int i = 0; i < inputs; ++i)
    if (traits_of(motion).input[static_cast<std::size_t>(i)].name == "steering")
      s.least_input[i] = -0.5, s.most_input[i] = 0.6;
  return s;
}

std::vector<AnyMotion> motions() { return registered::examples_of_all<AnyMotion>(); }

TEST(Plant, ClampsTheInputAndReportsWhatItApplied) {
  for (const AnyMotion& motion : motions()) {
    const int inputs = inputs_of(motion);
    const PlantSettings s = at_rest(motion);
    Plant plant(motion, s, 1, "plant");
    EXPECT_EQ(plant.executed(), SmallVector::Zero(inputs)) << "nothing yet";
    const SmallVector far = SmallVector::LinSpaced(inputs, -40, 50),
                      near = SmallVector::Constant(inputs, 0.1);
    for (const auto& [asked, done] :
         {std::pair(far, SmallVector(far.cwiseMax(s.least_input).cwiseMin(s.most_input))), {near, near}}) {
      const SmallVector before = plant.state();
      const SmallVector after = plant.move(asked, 0.5);
      EXPECT_EQ(plant.executed(), done);
      EXPECT_EQ(after, integrate(motion, before, done, 0.5)) << "as for the clamped command";
      EXPECT_EQ(after, plant.state());
    }
    const SmallVector before = plant.state();
    EXPECT_EQ(plant.move(far, 0), before) << "no displacement in zero time";
  }
}

TEST(Plant, HasDisturbancesThatItDoesNotReport) {
  PlantSettings s = at_rest(DifferentialDrive{});
  s.input_sigmas = vec({0.1, 0.2});
  Plant plant(DifferentialDrive{}, s, 3, "plant");
  const double dt = 0.01;
  double speed = 0, turn = 0, mean = 0;
  constexpr int ticks = 20'000;
  for (int k = 0; k < ticks; ++k) {
    const SmallVector before = plant.state();
    const SmallVector after = plant.move(vec({0.5, -0.3}), dt);
    EXPECT_EQ(plant.executed(), vec({0.5, -0.3})) << "the disturbance is not reported";
    const double w = wrap_angle(after[2] - before[2]) / dt, half = w * dt / 2;
    const double chord =
        (after - before).head<2>().dot(Vector2d(std::cos(before[2] + half), std::sin(before[2] + half)));
    const double v = chord / dt * half / std::sin(half);
    mean += (v - 0.5) / ticks, speed += (v - 0.5) * (v - 0.5) / ticks, turn += (w + 0.3) * (w + 0.3) / ticks;
  }
  // With 20 000 draws sigma is accurate to 0.5 %
  EXPECT_NEAR(std::sqrt(speed), 0.1, 0.002);
  EXPECT_NEAR(std::sqrt(turn), 0.2, 0.004);
  EXPECT_NEAR(mean, 0, 0.003) << "anew at each tick";
}

TEST(Plant, StartsWithTheStatedUncertainty) {
  const AnyMotion motion = FreeCameraMotion{};
  PlantSettings s = at_rest(motion);
  s.start_sigmas = SmallVector::LinSpaced(12, 0, 0.11);
  SmallVector squares = SmallVector::Zero(12);
  constexpr int draws = 4000;
  for (int seed = 0; seed < draws; ++seed) {
    const SmallVector x = Plant(motion, s, static_cast<std::uint64_t>(seed), "plant").state();
    squares += minus(FreeCameraMotion::chart, x, s.start).cwiseAbs2() / draws;
  }
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(std::sqrt(squares[i]), s.start_sigmas[i], 0.04 * s.start_sigmas[i]) << i;
}

std::vector<SmallVector> states(const AnyMotion& motion, std::uint64_t seed, const char* name) {
  PlantSettings s = at_rest(motion);
  s.start_sigmas.setConstant(0.1), s.input_sigmas.setConstant(0.2);
  Plant plant(motion, s, seed, name);
  std::vector<SmallVector> all{plant.state()};
  for (int k = 0; k < 10; ++k) all.push_back(plant.move(SmallVector::Constant(inputs_of(motion), 0.1), 0.1));
  return all;
}

TEST(Plant, IsDeterministicForASeedAndAName) {
  for (const AnyMotion& motion : motions()) {
    const auto first = states(motion, 7, "a");
    EXPECT_EQ(first, states(motion, 7, "a"));
    const auto other_seed = states(motion, 8, "a"), other_name = states(motion, 7, "b");
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_NE(first[k], other_seed[k]);
      EXPECT_NE(first[k], other_name[k]);
    }
  }
}

TEST(Plant, RefusesInvalidSettings) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const AnyMotion& motion : motions()) {
    const auto complaint = [&](auto change) {
      PlantSettings s = at_rest(motion);
      change(s);
      return message_of<std::invalid_argument>([&] { Plant(motion, s, 1, "plant"); });
    };
    EXPECT_EQ(complaint([](auto&) {}), "(none)");
    using Member = SmallVector PlantSettings::*;
    for (const Member member :
         {&PlantSettings::start, &PlantSettings::start_sigmas, &PlantSettings::input_sigmas,
          &PlantSettings::least_input, &PlantSettings::most_input}) {
      EXPECT_HAS(complaint([&](auto& s) { (s.*member).conservativeResize((s.*member).size() - 1); }),
                 "numbers, expected");
      EXPECT_HAS(complaint([&](auto& s) { (s.*member)[0] = nan; }), "must be finite");
    }
    EXPECT_HAS(complaint([](auto& s) { s.start_sigmas[0] = -1; }), "zero or positive");
    EXPECT_HAS(complaint([](auto& s) { s.input_sigmas[0] = -1; }), "zero or positive");
    EXPECT_HAS(complaint([](auto& s) { s.least_input[0] = 3; }), "exceeds the upper one");
    Plant plant(motion, at_rest(motion), 1, "plant");
    const SmallVector before = plant.state(), input = SmallVector::Zero(inputs_of(motion));
    const auto moving = [&](const SmallVector& u, double dt) {
      return message_of<std::invalid_argument>([&] { plant.move(u, dt); });
    };
    EXPECT_HAS(moving(SmallVector::Zero(9), 0.1), "9 numbers, expected");
    EXPECT_HAS(moving(SmallVector::Constant(input.size(), nan), 0.1), "must be finite");
    for (const double bad : {-0.1, nan, std::numeric_limits<double>::infinity()})
      EXPECT_HAS(moving(input, bad), "a tick must last zero or more seconds");
    EXPECT_EQ(plant.state(), before) << "a refused operation changes nothing";
  }
}

TEST(Plant, RefusesAnInvalidOrientationAndASteeringAboutTheMeasuredWheel) {
  const auto complaint = [](const AnyMotion& motion, const PlantSettings& s) {
    return message_of<std::invalid_argument>([&] { Plant(motion, s, 1, "plant"); });
  };
  PlantSettings body = at_rest(FreeCameraMotion{});
  for (const double w : {0.0, 2.0}) {
    body.start[3] = w;
    EXPECT_HAS(complaint(FreeCameraMotion{}, body), "unit quaternion");
  }
  const AckermannCar car;
  PlantSettings s = at_rest(car);
  // to the left, where the measured wheel is
  const double tightest = std::atan(car.wheelbase_m / car.wheel_left_m);
  for (const auto& [least, most, fits] :
       {std::tuple(-1.5, 0.99 * tightest, true), {-0.5, 1.01 * tightest, false}, {-1.6, 0.5, false}}) {
    s.least_input[1] = least, s.most_input[1] = most;
    EXPECT_EQ(complaint(car, s) == "(none)", fits) << least << " to " << most;
  }
}

}  // namespace
}  // namespace incognita
