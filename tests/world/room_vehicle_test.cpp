// A vehicle on the uneven floor of the rendered room: pose of its camera, wheel odometry, and collisions.
#include "incognita/world/rendered/proximity_ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/rendered/room_bodies.hpp"
#include "incognita/world/rendered/room_camera.hpp"

using namespace incognita;

namespace {

constexpr double pi = std::numbers::pi, radius_m = 0.2;
const TerrainVehicle body{Waves{0, {{0.08, 2, 0.4, 0.3}, {0.05, 1.5, 2, 1}}}};
const Mount mount{0.15, 0.05, 0.8, -0.1, 0.2};

SmallVector pair(double a, double b) { return Eigen::Vector2d(a, b); }

PlantSettings plant(const Eigen::Vector3d& start, double sigma_speed = 0) {
  PlantSettings s;
  s.start = start;
  s.start_sigmas = SmallVector::Zero(3);
  s.input_sigmas = pair(sigma_speed, 0);
  s.most_input = pair(1, 1);
  s.least_input = pair(-1, -1);
  return s;
}

RoomLayout empty_room() {
  RoomSettings s;
  s.boxes = 0;
  return room_layout(s, 1);
}

Command drive(double speed, double turn_rate) {
  Command command;
  command.bodies.push_back({pair(speed, turn_rate)});
  return command;
}

TEST(RoomVehicle, CarriesItsCameraAtTheMountedPose) {
  SimulatedWorld world(vehicle_in_room(body, mount, plant({0.3, -0.4, 0.7}), empty_room(), radius_m), 1);
  const auto start = world.move({}, {0, 0, 0});
  const MountedCamera<3> mounted_pose = mount.on(body.pose({0.3, -0.4, 0.7}));
  EXPECT_EQ(start->bodies[0].state, mounted_pose.camera);
  Truth before = *start;
  constexpr double dt = 1e-4;
  for (int k = 1; k <= 3000; ++k) {
    const Truth now = *world.move(drive(0.4, 0.5), {k, k * dt, dt});
    const Eigen::Vector3d moved = (now.bodies[0].state.head<3>() - before.bodies[0].state.head<3>()) / dt;
    EXPECT_NEAR(
        (moved - 0.5 * (now.bodies[0].state.segment<3>(7) + before.bodies[0].state.segment<3>(7))).norm(), 0,
        k == 1 ? 1 : 1e-4);
    const Eigen::Vector4d turned =
        quaternion_product<double>(quaternion_conjugate<double>(before.bodies[0].state.segment<4>(3)),
                                   now.bodies[0].state.segment<4>(3));
    EXPECT_NEAR((quaternion_log<double>(turned) / dt - now.bodies[0].state.tail<3>()).norm(), 0, 1e-3);
    before = now;
  }
}

TEST(RoomVehicle, StopsItsRadiusFromWallsAndCanTurnAndLeave) {
  const RoomLayout room = empty_room();
  const FloorPlan plan(room);
  SimulatedWorld world(vehicle_in_room(body, mount, plant({2, 0, 0}, 0.1), room, radius_m), 1);
  Truth truth = *world.move({}, {0, 0, 0});
  for (int k = 1; k < 100; ++k) {
    truth = *world.move(drive(0.8, 0), {k, k * 0.05, 0.05});
    ASSERT_GE(plan.clearance_at(truth.bodies[0].carrier.head<2>()), radius_m - 1e-12);
  }
  EXPECT_LT(plan.clearance_at(truth.bodies[0].carrier.head<2>()), radius_m + 0.06);
  EXPECT_NEAR((*truth.bodies[0].wheels)[0], 0.8, 0) << "its wheels go on turning";
  EXPECT_NEAR(truth.bodies[0].state.segment<3>(7).norm(), 0, 1e-12) << "and it stands";
  const double heading = truth.bodies[0].carrier[2];
  truth = *world.move(drive(0.8, 1), {100, 5, 0.05});
  EXPECT_GT(truth.bodies[0].carrier[2], heading + 0.03);
  for (int k = 101; k < 120; ++k) truth = *world.move(drive(-0.8, 0), {k, k * 0.05, 0.05});
  EXPECT_GT(plan.clearance_at(truth.bodies[0].carrier.head<2>()), 0.5);
}

TEST(RoomVehicle, RefusesToStartInAWall) {
  const SimulatedBody in_wall = vehicle_in_room(body, mount, plant({2.9, 0, 0}), empty_room(), radius_m);
  EXPECT_THROW(SimulatedWorld(in_wall, 1), std::invalid_argument);
}

/// The nearest obstacle inside a cone, by casting many rays.
double nearest_by_rays(const RoomLayout& room, const Eigen::Vector2d& at, double direction, double half) {
  double least = 1e9;
  for (int i = 0; i <= 400; ++i) {
    const double angle = direction + half * (i / 200.0 - 1);
    const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
    for (double t = 0; t < 9; t += 2e-3) {
      const Eigen::Vector3d p(at.x() + t * d.x(), at.y() + t * d.y(), 0.01);
      bool hit = std::abs(p.x()) > 3 || std::abs(p.y()) > 3;
      for (const Box& box : room.boxes) hit |= box.contains(p);
      if (!hit) continue;
      least = std::min(least, t);
      break;
    }
  }
  return least;
}

TEST(FloorPlan, ConesMeasureTheNearestObstacleInsideThem) {
  const RoomLayout room = room_layout(RoomSettings{}, 5);
  const FloorPlan plan(room);
  RandomStream random(2, "cones");
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d at(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    if (plan.clearance_at(at) < 0.1) continue;
    const double direction = random.uniform(-pi, pi), half = random.uniform(0.02, 0.4);
    EXPECT_NEAR(plan.clearance_towards(at, direction, half, 100), nearest_by_rays(room, at, direction, half),
                0.01);
  }
  EXPECT_EQ(plan.clearance_towards({0, 0}, 0, 0.1, 0.5), 0.5) << "its range limit where there is no obstacle";
}

TEST(FloorPlan, ARingHasNoGaps) {
  const RoomLayout room = room_layout(RoomSettings{}, 5);
  const FloorPlan plan(room);
  RandomStream random(2, "ring");
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d at(random.uniform(-2, 2), random.uniform(-2, 2));
    if (plan.clearance_at(at) == 0) continue;
    double least = 1e9;
    for (const ConeRange& cone : measure_ranges(plan, {24, 100, 0}, at, random.uniform(-pi, pi)))
      least = std::min(least, cone.range_m);
    EXPECT_NEAR(least, plan.clearance_at(at), 1e-9);
  }
}

TEST(RoomVehicle, ItsSensorMeasuresImagesWheelsAndRanges) {
  RoomSettings settings;
  settings.boxes = 0;
  settings.sigma_image_gray = 0;
  const auto room = std::make_shared<const Room>(settings, 1, body.terrain);
  SimulatedWorld world(vehicle_in_room(body, mount, plant({0, 0, 0}, 0.1), room->layout(), radius_m), 1);
  SensorSet sensors(
      sensors_of_body(std::make_unique<RoomCamera>(room, Camera{WideAngleCamera{}}, settings, 1),
                      std::make_unique<WheelEncoders>(),
                      std::make_unique<ProximityRing>(room->layout(), RangeRing{4, 10, 0}, 1)));
  const BodyObservation first = sensors.measure(world.move({}, {0, 0, 0}), {0, 0, 0}).bodies.at(0);
  EXPECT_TRUE(first.odometry.empty()) << "nothing was driven yet";
  ASSERT_EQ(first.proximity_ranges.size(), 4u);
  EXPECT_NEAR(first.proximity_ranges[0].range_m, 3, 1e-9);
  EXPECT_NEAR(first.proximity_ranges[0].bearing_rad, pi / 4, 1e-12);
  const auto truth = world.move(drive(0.5, 7), {1, 0.1, 0.1});
  const BodyObservation observation = sensors.measure(truth, {1, 0.1, 0.1}).bodies.at(0);
  ASSERT_EQ(observation.odometry.size(), 1u);
  EXPECT_EQ(observation.odometry[0].input, Eigen::Vector2d(0.5, 1)) << "what it can do";
  ASSERT_TRUE(image_of(observation));
  EXPECT_EQ(image_of(observation)->width(), 320);
}

}  // namespace
