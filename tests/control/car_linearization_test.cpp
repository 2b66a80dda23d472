// The linearizing law on a car: exact within the steering limit, well-defined everywhere else.
#include "incognita/control/car_linearization.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/control/feedback_linearization.hpp"
#include "incognita/control/paths/reference_path.hpp"
#include "incognita/math/random.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

/// The car of the ACFR car park, whose sensor is ahead of the front axle.
AckermannCar park_car() {
  AckermannCar car;
  car.body = {3.78, 0.5};
  return car;
}

CarLinearizationSettings of_park_car() {
  CarLinearizationSettings settings;
  settings.car = park_car();
  return settings;
}

using Eigen::Vector2d;
using testing::message_of;
using Pose = planar::Pose<double>;

Vector2d point_velocity(const AckermannCar& car, double heading, const CarCommand& command) {
  return point_velocity_by_input(car.body, heading) * car.at_axle<double>(wheel_input(car, command));
}

Pose drive(const AckermannCar& car, Pose pose, const CarCommand& command, double hold_s) {
  for (int i = 0; i < 100; ++i) pose = car.f<double>(pose, wheel_input(car, command), hold_s / 100);
  return pose;
}

TEST(CarLinearization, IsExactWithinTheSteeringLimitAndNeverFasterOutside) {
  RandomStream random(1, "cars");
  const AckermannCar car = park_car();
  const CarLimits limits{3, 0.5};
  int exact = 0, outside = 0;
  for (int i = 0; i < 3000; ++i) {
    const double heading = random.uniform(-4, 4);
    const Vector2d desired(random.normal(), random.normal());
    const CarCommand command = car_for_velocity(car, heading, desired, limits);
    EXPECT_LE(std::abs(command.speed_m_s), limits.max_speed_m_s);
    EXPECT_LE(std::abs(command.steering_rad), limits.max_steering_rad);
    const Vector2d moves = point_velocity(car, heading, command);
    if (command.saturated) {
      EXPECT_GT(moves.dot(desired), 0) << "starts towards the goal";
      EXPECT_LE(moves.norm(), desired.norm() * (1 + 1e-12));
      ++outside;
    } else {
      EXPECT_LE((moves - desired).norm(), 1e-12);
      ++exact;
    }
  }
  EXPECT_GT(exact, 300);
  EXPECT_GT(outside, 300);
}

TEST(CarLinearization, IsDefinedAtRestAndAbeam) {
  const AckermannCar car = park_car();
  const CarCommand rest = car_for_velocity(car, 0.3, {0, 0}, {});
  EXPECT_EQ(rest.speed_m_s, 0);
  EXPECT_EQ(rest.steering_rad, 0);
  EXPECT_FALSE(rest.saturated);
  const CarCommand abeam =
      car_for_velocity({.body = {3.78, 0}}, 0, {0, 1}, {});  // the axle would stand still
  EXPECT_TRUE(abeam.saturated);
  EXPECT_DOUBLE_EQ(abeam.steering_rad, CarLimits{}.max_steering_rad);
  EXPECT_GT(abeam.speed_m_s, 0) << "forward, since both directions are equally near";
  const CarCommand fast = car_for_velocity(car, 0, {100, 0}, {});
  EXPECT_DOUBLE_EQ(fast.speed_m_s, CarLimits{}.max_speed_m_s);
  EXPECT_EQ(fast.steering_rad, 0);
  EXPECT_TRUE(fast.saturated);
  const CarCommand back = car_for_velocity(car, 0, {-1, 0}, {});
  EXPECT_DOUBLE_EQ(back.speed_m_s, -1);
  EXPECT_EQ(back.steering_rad, 0);
}

TEST(CarLinearization, ConvergesFromAnywhere) {
  RandomStream random(2, "starts");
  CarLinearizationSettings settings = of_park_car();
  settings.gain_per_s = 0.5 * Eigen::Matrix2d::Identity();
  const CarLinearization law(settings);
  for (int i = 0; i < 60; ++i) {
    Pose pose(random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-4, 4));
    for (int k = 0; k < 1200; ++k) pose = drive(settings.car, pose, law.act(pose, {}), settings.hold_s);
    EXPECT_LT(pose.head<2>().norm(), 0.02);
  }
}

TEST(CarLinearization, FollowsACircleWithinItsTurningRadius) {
  const CarLinearizationSettings settings = of_park_car();
  const CarLinearization law(settings);
  const Path circle = CirclePath{.radius_m = 12, .rate_rad_s = -0.15};
  Pose pose(10, 3, -1);
  double worst_late = 0;
  for (int k = 0; k < 900; ++k) {
    const Reference reference = at(circle, 0.1 * k);
    if (k > 600) worst_late = std::max(worst_late, (pose.head<2>() - reference.position.head<2>()).norm());
    pose = drive(settings.car, pose, law.act(pose, reference), settings.hold_s);
  }
  EXPECT_LT(worst_late, 0.03);
}

TEST(CarLinearization, RefusesInvalidSettings) {
  const auto complaint = [](auto change) {
    CarLinearizationSettings settings = of_park_car();
    change(settings);
    return message_of<std::invalid_argument>([&] { CarLinearization law(settings); });
  };
  using S = CarLinearizationSettings;
  EXPECT_EQ(complaint([](S&) {}), "(none)");
  EXPECT_HAS(complaint([](S& s) { s.car.body.forward_m = 0; }), "before or behind the axle");
  EXPECT_HAS(complaint([](S& s) { s.car.wheelbase_m = 0; }), "wheelbase must be positive");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_steering_rad = 1.6; }), "between 0 and pi/2");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_steering_rad = 0; }), "between 0 and pi/2");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_steering_rad = 1.4; }), "the center of the turn");
  EXPECT_HAS(complaint([](S& s) { s.limits.max_speed_m_s = -1; }), "speed limit must be positive");
  EXPECT_HAS(complaint([](S& s) { s.gain_per_s *= 30; }), "it must be less than 20 1/s");
  EXPECT_HAS(complaint([](S& s) { s.gain_per_s = Eigen::MatrixXd::Identity(3, 2); }), "3x2, not 2x2");
  const CarLinearization law(of_park_car());
  EXPECT_HAS(message_of<std::invalid_argument>([&] { law.act({0, INFINITY, 0}, {}); }), "not finite");
}

}  // namespace
}  // namespace incognita
