#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/heading.hpp"
#include "tests/world/camera_in_room.hpp"

using namespace incognita;
using incognita::testing::CameraInRoom;

namespace {

constexpr double dt = 1.0 / 30;

RoomSettings quiet() {
  RoomSettings s;
  s.boxes = 0;
  s.start_position_m = {0, 0, 1.2};
  s.sigma_start_position_m = s.sigma_start_heading_rad = 0;
  s.sigma_acceleration_m_s2 = s.sigma_angular_acceleration_rad_s2 = 0;
  return s;
}

CameraInRoom plant_in(const RoomSettings& s, std::uint64_t seed = 1) {
  return CameraInRoom(s, room_layout(s, seed), seed);
}

using Input = FreeCameraMotion::Input<double>;

Input push(const Eigen::Vector3d& linear = {0, 0, 0}, const Eigen::Vector3d& angular = {0, 0, 0}) {
  return (Input() << linear, angular).finished();
}

void move_for(CameraInRoom& plant, const Input& input, int ticks) {
  for (int i = 0; i < ticks; ++i) plant.move(input, dt);
}

TEST(LevelGaze, FacesItsHeadingWithTheFloorDown) {
  for (const double heading : {0.0, 0.7, std::numbers::pi, -2.0}) {
    const Eigen::Matrix3d r = rotation_matrix<double>(level_gaze(heading));
    EXPECT_NEAR((r.col(2) - Eigen::Vector3d(std::cos(heading), std::sin(heading), 0)).norm(), 0, 1e-12);
    EXPECT_NEAR((r.col(1) - Eigen::Vector3d(0, 0, -1)).norm(), 0, 1e-12);
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
  }
}

TEST(CameraInRoom, StartsAtRestAtTheGivenPose) {
  RoomSettings s = quiet();
  s.start_heading_rad = 0.4;
  const auto plant = plant_in(s);
  EXPECT_EQ(plant.state().head<3>(), s.start_position_m);
  EXPECT_EQ((plant.state().segment<4>(3)), level_gaze(0.4));
  EXPECT_TRUE(plant.state().tail<6>().isZero());
}

TEST(CameraInRoom, ConstantAccelerationGivesTheParabola) {
  auto plant = plant_in(quiet());
  const Eigen::Vector3d a(0.5, -0.3, 0.2);
  move_for(plant, push(a), 45);
  const double t = 45 * dt;
  EXPECT_NEAR((plant.state().head<3>() - (Eigen::Vector3d(0, 0, 1.2) + 0.5 * t * t * a)).norm(), 0, 1e-9);
  EXPECT_NEAR((plant.state().segment<3>(7) - t * a).norm(), 0, 1e-9);
}

TEST(CameraInRoom, ConstantAngularAccelerationGivesHalfAlphaTSquared) {
  auto plant = plant_in(quiet());
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -0.5).normalized();
  move_for(plant, push(Eigen::Vector3d::Zero(), 0.8 * axis), 60);
  const double t = 60 * dt;
  const Eigen::Vector4d turned =
      quaternion_product<double>(level_gaze(0), quaternion_exp<double>(Eigen::Vector3d(0.4 * t * t * axis)));
  const Eigen::Vector4d apart = quaternion_product<double>(quaternion_conjugate<double>(turned),
                                                           Eigen::Vector4d(plant.state().segment<4>(3)));
  EXPECT_NEAR(quaternion_log<double>(apart).norm(), 0, 1e-8);
  EXPECT_NEAR((plant.state().tail<3>() - 0.8 * t * axis).norm(), 0, 1e-9);
  EXPECT_NEAR(plant.state().segment<4>(3).norm(), 1, 1e-14);
}

/// A right turn about the camera's down axis reduces the heading about z.
TEST(CameraInRoom, APositiveRateAboutTheDownAxisTurnsRight) {
  auto plant = plant_in(quiet());
  move_for(plant, push(Eigen::Vector3d::Zero(), {0, 1, 0}), 30);
  const Eigen::Vector3d forward =
      rotation_matrix<double>(Eigen::Vector4d(plant.state().segment<4>(3))).col(2);
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), -0.5, 1e-8);
}

TEST(CameraInRoom, AgreesWithTheDiscreteModelForShortSteps) {
  auto plant = plant_in(quiet());
  move_for(plant, push({0.3, 0.1, 0}, {0.4, -0.6, 0.2}), 20);
  const Input input = push({0.3, -0.2, 0.1}, {0.2, 0.3, -0.4});
  const double step = 1e-4;
  const auto expected = FreeCameraMotion{}.f<double>(plant.state(), input, step);
  EXPECT_NEAR((plant.move(input, step) - expected).norm(), 0, 1e-7);
}

TEST(CameraInRoom, WallsStopTheBodyAndLetItSlide) {
  auto plant = plant_in(quiet());
  move_for(plant, push({2, 0.3, 0}), 75);
  EXPECT_DOUBLE_EQ(plant.state()[0], 3 - 0.15);
  EXPECT_DOUBLE_EQ(plant.state()[7], 0);
  EXPECT_NEAR(plant.state()[1], 0.15 * 2.5 * 2.5, 1e-9) << "motion along the wall goes on";
  move_for(plant, push({-1, 0, 0}), 30);
  EXPECT_NEAR(plant.state()[0], 3 - 0.15 - 0.5, 1e-9) << "motion away from the wall is free";
}

TEST(CameraInRoom, FloorAndCeilingStopIt) {
  auto plant = plant_in(quiet());
  move_for(plant, push({0, 0, -3}), 60);
  EXPECT_DOUBLE_EQ(plant.state()[2], 0.15);
  move_for(plant, push({0, 0, 3}), 90);
  EXPECT_DOUBLE_EQ(plant.state()[2], 2.5 - 0.15);
}

TEST(CameraInRoom, ABoxStopsItAtAnySpeed) {
  const RoomSettings s = quiet();
  RoomLayout layout = room_layout(s, 1);
  layout.boxes.push_back({{1, -0.5, 0}, {1.3, 0.5, 1.8}});
  CameraInRoom plant(s, layout, 1);
  plant.move(push({3000, 0, 0}), dt);
  EXPECT_DOUBLE_EQ(plant.state()[0], 1 - 0.15);
  EXPECT_DOUBLE_EQ(plant.state()[7], 0);
  plant.move(push({0, 1, 0}), dt);
  EXPECT_GT(plant.state()[1], 0) << "it slides along the box";
}

TEST(CameraInRoom, NeverEntersAnObstacle) {
  RoomSettings s;
  s.sigma_acceleration_m_s2 = 30;
  const RoomLayout layout = room_layout(s, 3);
  CameraInRoom plant(s, layout, 3);
  RandomStream random(3, "test.push");
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d jolt(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d p = plant.move(push(20 * jolt), dt).head<3>();
    ASSERT_TRUE(layout.inside.grown(1e-9 - s.clearance_m).contains(p)) << p.transpose();
    for (const Box& box : layout.boxes)
      ASSERT_FALSE(box.grown(s.clearance_m - 1e-9).contains(p)) << p.transpose();
  }
}

TEST(CameraInRoom, SameSeedSameStatesAndAnotherSeedOthers) {
  auto a = plant_in(RoomSettings{}, 5), b = plant_in(RoomSettings{}, 5), c = plant_in(RoomSettings{}, 6);
  EXPECT_EQ(a.state(), b.state());
  EXPECT_NE(a.state(), c.state());
  move_for(a, push(), 30);
  move_for(b, push(), 30);
  EXPECT_EQ(a.state(), b.state());
}

TEST(CameraInRoom, DisturbancesHaveTheStatedSigma) {
  RoomSettings s = quiet();
  s.sigma_acceleration_m_s2 = 0.3;
  s.sigma_angular_acceleration_rad_s2 = 0.5;
  double linear = 0, angular = 0;
  constexpr int runs = 1000;
  for (int seed = 0; seed < runs; ++seed) {
    auto plant = plant_in(s, seed);
    plant.move(push(), dt);
    linear += plant.state().segment<3>(7).squaredNorm();
    angular += plant.state().segment<3>(10).squaredNorm();
  }
  // their standard error is 1.3 %
  EXPECT_NEAR(std::sqrt(linear / (3 * runs)) / dt, 0.3, 0.3 * 0.05);
  EXPECT_NEAR(std::sqrt(angular / (3 * runs)) / dt, 0.5, 0.5 * 0.05);
}

TEST(CameraInRoom, RefusesInvalidSettings) {
  RoomSettings outside = quiet();
  outside.start_position_m.x() = 2.9;
  EXPECT_THROW(plant_in(outside), std::invalid_argument);
  RoomSettings negative = quiet();
  negative.sigma_acceleration_m_s2 = -1;
  EXPECT_THROW(plant_in(negative), std::invalid_argument);
  auto plant = plant_in(quiet());
  EXPECT_THROW(plant.move(push(), -dt), std::invalid_argument);
  EXPECT_THROW(plant.move(push({NAN, 0, 0}), dt), std::invalid_argument);
}

TEST(CameraInRoom, TheFirstTickReturnsTheStart) {
  const RoomSettings s;
  SimulatedWorld world(camera_in_room(s, room_layout(s, 2), 2), 2);
  const auto first = world.move({{BodyCommand{push({1, 1, 1})}}}, Tick{0, 0, 0});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->bodies[0].state, SmallVector(plant_in(s, 2).state()));
  EXPECT_NE(world.move({}, Tick{1, dt, dt})->bodies[0].state, first->bodies[0].state);
}

/// The true start is drawn about the nominal one, and stays in the room.
TEST(CameraInRoom, ADrawnStartInAWallIsMovedOutOfIt) {
  RoomSettings s = quiet();
  s.start_position_m = {2.8, 0, 1.2};
  s.sigma_start_position_m = 0.3;
  int at_wall = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const double x = plant_in(s, static_cast<std::uint64_t>(seed)).state()[0];
    EXPECT_LE(x, 3 - 0.15);
    at_wall += x == 3 - 0.15;
  }
  EXPECT_GT(at_wall, 3);
}

}  // namespace
