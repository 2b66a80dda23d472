// Simulated bodies: a camera on a vehicle on uneven ground, its pose and velocities; what does not fit a body.
#include "incognita/world/simulated_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "incognita/world/sensor_set.hpp"

namespace incognita {
namespace {

using FreeState = FreeCameraMotion::State<double>;

const TerrainVehicle ground_vehicle{
    Waves{0, {{0.1, 3, 0, 0}, {0.1, 3, 1.5707963267948966, 1.5707963267948966}}}};

SimulatedBody on_waves() {
  SimulatedBody c{ground_vehicle, {}, "carrier"};
  c.plant.start = SmallVector::Zero(3);
  c.plant.start << 0.4, -0.3, 0.7;
  c.plant.start_sigmas = SmallVector::Zero(3);
  c.plant.input_sigmas = SmallVector::Zero(2);
  c.plant.most_input = SmallVector::Ones(2);
  c.plant.least_input = -c.plant.most_input;
  c.mount = Mount{0.3, 0.1, 0.6, 0.2, 0.4};
  return c;
}

Command drive(double speed, double turn_rate) {
  Command command;
  command.bodies.push_back({(SmallVector(2) << speed, turn_rate).finished()});
  return command;
}

Tick tick(int frame, double t, double dt) {
  Tick out;
  out.frame = frame;
  out.t = t;
  out.dt = dt;
  return out;
}

TEST(CarriedCamera, VelocitiesAreDerivativesOfThePose) {
  SimulatedWorld world(on_waves(), 1);
  constexpr double dt = 1e-4;
  FreeState before = world.move({}, tick(0, 0, 0))->bodies[0].state;
  for (int i = 1; i < 50; ++i) world.move(drive(0.6, 0.5), tick(i, 0.1 * i, 0.1));
  before = world.move(drive(0.6, 0.5), tick(50, 5, dt))->bodies[0].state;
  const Truth middle = *world.move(drive(0.6, 0.5), tick(51, 5 + dt, dt));
  const FreeState after = world.move(drive(0.6, 0.5), tick(52, 5 + 2 * dt, dt))->bodies[0].state;
  const Eigen::Vector3d velocity = (after.head<3>() - before.head<3>()) / (2 * dt);
  EXPECT_NEAR((velocity - middle.bodies[0].state.segment<3>(7)).norm(), 0, 1e-6);
  const Eigen::Vector4d turned = quaternion_product<double>(
      quaternion_conjugate<double>(Eigen::Vector4d(before.segment<4>(3))), after.segment<4>(3));
  EXPECT_NEAR((quaternion_log<double>(turned) / (2 * dt) - middle.bodies[0].state.tail<3>()).norm(), 0, 1e-6);
  EXPECT_GT(middle.bodies[0].state.tail<3>().norm(), 0.4) << "it turns";
  EXPECT_TRUE(middle.bodies[0].input.isZero()) << "accelerations are not commanded";
  EXPECT_EQ(middle.bodies[0].wheels, Eigen::Vector2d(0.6, 0.5));
}

TEST(CarriedCamera, IsTheMountsDistanceFromTheGroundUnderTheAxle) {
  const SimulatedBody carrier = on_waves();
  SimulatedWorld world(carrier, 1);
  for (int i = 0; i < 100; ++i) {
    const FreeState camera =
        world.move(drive(-0.5, 0.3), tick(i, 0.1 * i, i == 0 ? 0 : 0.1))->bodies[0].state;
    const Eigen::Matrix3d world_from_body = rotation_matrix<double>(Eigen::Vector4d(camera.segment<4>(3))) *
                                            carrier.mount->body_from_camera().transpose();
    const Eigen::Vector3d axle = camera.head<3>() - world_from_body * carrier.mount->lever();
    const GroundPoint<double> ground = ground_vehicle.terrain.at<double>(axle.x(), axle.y());
    EXPECT_NEAR(axle.z(), ground.height, 1e-9);
    const Eigen::Vector3d normal = Eigen::Vector3d(-ground.x, -ground.y, 1).normalized();
    EXPECT_NEAR(world_from_body.col(2).dot(normal), 1, 1e-9) << "upright on the ground";
  }
}

TEST(CarriedCamera, StandsWithoutACommandAndRespectsTheLimits) {
  SimulatedWorld world(on_waves(), 1);
  const FreeState first = world.move({}, tick(0, 0, 0))->bodies[0].state;
  EXPECT_EQ(world.move({}, tick(1, 0.1, 0.1))->bodies[0].state, first);
  EXPECT_EQ(world.move(drive(7, -7), tick(2, 0.2, 0.1))->bodies[0].wheels, Eigen::Vector2d(1, -1));
}

TEST(SimulatedWorld, RefusesAMountOrAnOperatorThatDoesNotFit) {
  SimulatedBody mounted = on_waves();
  mounted.motion = DifferentialDrive{};
  EXPECT_THROW(SimulatedWorld(mounted, 1), std::invalid_argument);
  SimulatedBody held = on_waves();
  const OperatorMotion rest = [](const FreeState&, const Segment&, const Heading&, double) {
    return FreeCameraMotion::Input<double>(FreeCameraMotion::Input<double>::Zero());
  };
  held.actuator.emplace(OperatorModel({}, 1, "person"), rest);
  EXPECT_THROW(SimulatedWorld(held, 1), std::invalid_argument) << "it drives";
  EXPECT_THROW(SimulatedWorld(std::vector<SimulatedBody>{}, 1), std::invalid_argument);
}

/// Its encoders measure the drive that was executed, and nothing before the first tick has passed.
TEST(WheelEncoders, MeasureTheVehicleThatCarriesTheCamera) {
  SimulatedWorld world(on_waves(), 1);
  SensorSet sensors(sensors_of_body(std::make_unique<WheelEncoders>()));
  const Tick first = tick(0, 0, 0), second = tick(1, 0.1, 0.1);
  EXPECT_TRUE(sensors.measure(world.move({}, first), first).bodies[0].odometry.empty());
  const BodyObservation body = sensors.measure(world.move(drive(0.6, 7), second), second).bodies[0];
  ASSERT_EQ(body.odometry.size(), 1u);
  EXPECT_EQ(body.odometry[0].t, 0.1);
  EXPECT_EQ(body.odometry[0].input, Eigen::Vector2d(0.6, 1)) << "within its limits";
  EXPECT_THROW(sensors.measure(Truth{{BodyTruth{}}}, second), std::invalid_argument) << "no vehicle";
}

}  // namespace
}  // namespace incognita
