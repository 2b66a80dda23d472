// The vehicles of Chapter 3 against their exact motion and against each other.
#include "incognita/models/motion/planar_vehicle.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace incognita {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Small steps of a model converge to the circle of a rigid body with constant speed and turn rate.
Vector3d driven(const DifferentialDrive& vehicle, Vector3d x, const Vector2d& u, double seconds, int steps) {
  for (int i = 0; i < steps; ++i) x = vehicle.step(x, u, seconds / steps).x;
  return x;
}

Vector3d on_circle(const DifferentialDrive& vehicle, const Vector3d& x, const Vector2d& u, double seconds) {
  const auto lever = [&](double heading) {
    return Vector2d(vehicle.forward_m * std::cos(heading) - vehicle.left_m * std::sin(heading),
                    vehicle.forward_m * std::sin(heading) + vehicle.left_m * std::cos(heading));
  };
  const double after = x[2] + u[1] * seconds, radius = u[0] / u[1];
  const Vector2d axle = x.head<2>() - lever(x[2]) +
                        radius * Vector2d(std::sin(after) - std::sin(x[2]), std::cos(x[2]) - std::cos(after));
  const Vector2d point = axle + lever(after);
  return {point.x(), point.y(), wrap_angle(after)};
}

TEST(DifferentialDrive, SmallStepsFollowTheExactCircle) {
  for (const DifferentialDrive vehicle : {DifferentialDrive{}, {0.1, 0}, {3.78, 0.5}, {-1, -2}}) {
    const Vector3d start(1, -2, 2.5);
    const Vector2d u(1.3, 0.8);
    const Vector3d exact = on_circle(vehicle, start, u, 5);
    const double coarse = (driven(vehicle, start, u, 5, 1000) - exact).norm();
    const double fine = (driven(vehicle, start, u, 5, 4000) - exact).norm();
    EXPECT_LT(fine, 0.02);
    EXPECT_NEAR(coarse / fine, 4, 0.1) << "an Euler step: error proportional to dt";
  }
}

TEST(AckermannCar, DrivesStraightWithoutSteering) {
  const AckermannCar car;
  const Vector3d after = car.step({0, 0, std::numbers::pi / 2}, {2, 0}, 0.5).x;
  EXPECT_LE((after - Vector3d(0, 1, std::numbers::pi / 2)).norm(), 1e-15);
}

TEST(AckermannCar, LeftRearWheelIsTheSlowerOneInALeftTurn) {
  const AckermannCar car;
  const double steering = 0.4;
  const Vector2d axle = car.at_axle<double>({1, steering});
  EXPECT_GT(axle[0], 1);
  // Each wheel of the axle rolls about one center: that at tan(steering) = wheelbase / radius
  const double radius = car.wheelbase_m / std::tan(steering);
  EXPECT_NEAR(axle[1], 1 / (radius - car.wheel_left_m), 1e-15);
  EXPECT_NEAR(axle[0], radius * axle[1], 1e-15);
  EXPECT_LT(car.at_axle<double>({1, -steering})[0], 1);
}

}  // namespace
}  // namespace incognita
