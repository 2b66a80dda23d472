// Obstacle avoidance of a vehicle that is commanded to drive into obstacles.
#include "incognita/control/obstacle_avoidance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "incognita/math/random.hpp"
#include "incognita/world/rendered/floor_plan.hpp"

namespace incognita {
namespace {

constexpr double pi = std::numbers::pi;
const ObstacleAvoidanceSettings settings{0.8, 0.3, {0.5, 0.6}};

ConeRange cone(double bearing, double range) { return {bearing, 0, range}; }

TEST(ObstacleAvoidance, KeepsACommandInFreeSpace) {
  const std::vector<ConeRange> around{cone(0, 0.81), cone(pi / 2, 0.31), cone(pi, 0.31)};
  const AvoidanceCommand clear = avoid_obstacles({0.5, 0.1}, around, settings, TurnSide::left);
  EXPECT_EQ(clear.drive, Eigen::Vector2d(0.5, 0.1));
  EXPECT_EQ(clear.turn_side, TurnSide::none) << "the side of the turn is reset";
  EXPECT_EQ(avoid_obstacles({0, 0.4}, {}, settings, TurnSide::none).drive, Eigen::Vector2d(0, 0.4));
}

TEST(ObstacleAvoidance, ReducesTheSpeedInProportion) {
  // Full speed from avoidance_distance_m on, zero at the radius
  for (const double range : {0.8, 0.55, 0.4, 0.3, 0.1}) {
    const double expected = 0.5 * std::clamp((range - 0.3) / 0.5, 0.0, 1.0);
    EXPECT_NEAR(avoid_obstacles({0.5, 0}, std::vector{cone(0, range)}, settings, TurnSide::none).drive[0],
                expected, 1e-12);
    EXPECT_NEAR(avoid_obstacles({-0.5, 0}, std::vector{cone(pi, range)}, settings, TurnSide::none).drive[0],
                -expected, 1e-12);
    EXPECT_EQ(avoid_obstacles({-0.5, 0}, std::vector{cone(0, range)}, settings, TurnSide::none).drive[0],
              -0.5);
  }
}

TEST(ObstacleAvoidance, TakesTheWorstPositionInsideACone) {
  const std::vector<ConeRange> wide{{1.7, 0.3, 0.3}};
  EXPECT_NEAR(avoid_obstacles({0.5, 0}, wide, settings, TurnSide::none).drive[0], 0, 1e-12);
  const std::vector<ConeRange> narrow{{1.7, 0.1, 0.3}};
  EXPECT_EQ(avoid_obstacles({0.5, 0}, narrow, settings, TurnSide::none).drive[0], 0.5);
}

TEST(ObstacleAvoidance, TurnsToTheFreerSideAndKeepsIt) {
  const std::vector<ConeRange> around{cone(0, 0.3), cone(0.5, 0.6), cone(-0.5, 2)};
  const AvoidanceCommand right = avoid_obstacles({0.5, 0.2}, around, settings, TurnSide::none);
  EXPECT_EQ(right.turn_side, TurnSide::right);
  EXPECT_NEAR(right.drive[1], -0.6, 1e-12);
  const AvoidanceCommand left = avoid_obstacles({0.5, 0.2}, around, settings, TurnSide::left);
  EXPECT_EQ(left.turn_side, TurnSide::left);
  EXPECT_NEAR(left.drive[1], 0.6, 1e-12);
  // Reversing: it turns away from an obstacle behind on its right
  const std::vector<ConeRange> behind{cone(-pi + 0.1, 0.3), cone(pi - 0.5, 2)};
  EXPECT_LT(avoid_obstacles({-0.5, 0}, behind, settings, TurnSide::none).drive[1], 0);
}

TEST(ObstacleAvoidance, RefusesInvalidSettings) {
  EXPECT_THROW((ObstacleAvoidanceSettings{0.3, 0.3, {1, 1}}.check()), std::invalid_argument);
  EXPECT_THROW((ObstacleAvoidanceSettings{0.8, 0.3, {0, 1}}.check()), std::invalid_argument);
  EXPECT_NO_THROW(settings.check());
}

struct Drive {
  double nearest_m = 1e9;  ///< minimum over the drive
  double distance_m = 0;
};

/// Drives through a room with random commands, or always the same one, and ranges as of a ring of sonars.
Drive driven(std::uint64_t seed, bool at_random) {
  const FloorPlan plan(room_layout(RoomSettings{}, seed));
  RandomStream random(seed, "drive");
  Eigen::Vector2d at(0, 0), commanded(0.5, 0);
  double heading = random.uniform(-pi, pi);
  TurnSide turn_side = TurnSide::none;
  Drive drive;
  const double dt = 0.05;
  for (int k = 0; k < 2400; ++k) {
    if (at_random && k % 40 == 0) commanded = {random.uniform(-0.5, 0.5), random.uniform(-0.6, 0.6)};
    std::vector<ConeRange> around = measure_ranges(plan, {}, at, heading);
    for (ConeRange& c : around) c.range_m += 0.01 * random.normal();
    const AvoidanceCommand clear = avoid_obstacles(commanded, around, settings, turn_side);
    turn_side = clear.turn_side;
    const double turn = clear.drive[1] * dt;
    at += clear.drive[0] * dt * Eigen::Vector2d(std::cos(heading + turn / 2), std::sin(heading + turn / 2));
    heading += turn;
    drive.nearest_m = std::min(drive.nearest_m, plan.clearance_at(at));
    drive.distance_m += std::abs(clear.drive[0]) * dt;
  }
  return drive;
}

// Without avoidance each of these drives ends at a wall: the commands add up to 60 m in a room of 6 m.
TEST(ObstacleAvoidance, KeepsItsDistance) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (const bool at_random : {false, true}) {
      const Drive drive = driven(seed, at_random);
      EXPECT_GT(drive.nearest_m, settings.radius_m - 0.03) << seed;
      EXPECT_GT(drive.distance_m, 10) << seed << ": it gets stuck";
    }
}

}  // namespace
}  // namespace incognita
