// States predicted for actions, against exact motion.
#include "incognita/decision/action_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"

namespace incognita {
namespace {

BlockVector level_camera(double heading) {
  BlockVector x = BlockVector::Zero(13);
  x.head<3>() << 1, 2, 1.2;
  x.segment<4>(3) = level_gaze(heading);
  x.tail<6>() << 0.1, 0.2, 0, 0, 0.3, 0;
  return x;
}

TEST(Translations, FollowTheHeadingAndGravityFromRestToRest) {
  const Translations moves(seven_translations(0.3), 1, growth_over(1, 0.3, 0.3), {});
  const BlockVector x = level_camera(1);
  const Eigen::Vector3d ahead(std::cos(1.0), std::sin(1.0), 0), left(-std::sin(1.0), std::cos(1.0), 0);
  const Eigen::Vector3d ways[] = {ahead,
                                  -ahead,
                                  -left,
                                  left,
                                  Eigen::Vector3d::UnitZ(),
                                  -Eigen::Vector3d::UnitZ(),
                                  Eigen::Vector3d::Zero()};
  for (int a = 0; a < 7; ++a) {
    const ActionOutcome out = moves.after(x, a);
    EXPECT_NEAR((out.state.head<3>() - x.head<3>() - 0.3 * ways[a]).norm(), 0, 1e-12)
        << moves.actions()[a].name;
    EXPECT_TRUE(out.state.tail<6>().isZero());
    EXPECT_TRUE(out.allowed());
  }
  EXPECT_EQ(moves.stay(), 6);
}

TEST(Translations, RotateAtTheGazeRate) {
  Translations moves(seven_translations(0.3), 2, growth_over(2, 0.3, 0.3), {});
  moves.turn_at(0.2);
  EXPECT_NEAR(heading_of(Eigen::Vector4d(moves.after(level_camera(1), 6).state.segment<4>(3))), 1.4, 1e-9);
}

TEST(Translations, RiseAndFallWithTheGazeBetweenItsLargestElevations) {
  Translations moves(seven_translations(0.3), 1, growth_over(1, 0.3, 0.3), {});
  moves.turn_at(0.2, 0.4, 0.5);
  const auto after = [&](double elevation_rad) {
    BlockVector state = CameraState::Zero();
    state.segment<4>(3) = gaze_at(0.3, elevation_rad);
    const Eigen::Vector4d gaze = moves.after(state, moves.stay()).state.segment<4>(3);
    EXPECT_NEAR(heading_of(gaze), 0.5, 1e-9);
    return elevation_of(gaze);
  };
  EXPECT_NEAR(after(0), 0.4, 1e-9);
  EXPECT_NEAR(after(0.3), 0.3, 1e-9) << "up to 0.5 and back";
}

TEST(Translations, AreAllowedInsideTheBoundsAndStayingAlways) {
  const Translations moves(seven_translations(0.3), 1, growth_over(1, 0.3, 0.3), {{0, 0, 0}, {1.1, 9, 9}});
  EXPECT_FALSE(moves.after(level_camera(0), 0).allowed());
  EXPECT_TRUE(moves.after(level_camera(0), 1).allowed());
  BlockVector outside = level_camera(0);
  outside[0] = 5;
  EXPECT_TRUE(moves.after(outside, 6).allowed());
}

TEST(Actions, UserActionsHaveNamesAndMustIncludeStay) {
  const auto own = named(std::vector<Eigen::Vector3d>{{0.5, 0, 0}, {0.2, 0, 0}, {0.1, 0.1, 0}, {0, 0, 0}});
  EXPECT_EQ(own[0].name, "go_forward");
  EXPECT_EQ(own[1].name, "go_forward_2");
  EXPECT_EQ(own[2].name, "go_+0.1_+0.1_+0");
  EXPECT_EQ(own[3].name, "stay");
  EXPECT_THROW(
      Translations(named(std::vector<Eigen::Vector3d>{{0.5, 0, 0}}), 1, growth_over(1, 0.3, 0.3), {}),
      std::invalid_argument);
}

TEST(Actions, AreThoseOfTable61) {
  const auto table = table_6_1(0.5, 0.3, 0.1);
  const char* names[] = {"stay", "right", "left", "slower", "faster", "slower_right", "faster_left"};
  ASSERT_EQ(table.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(table[i].name, names[i]);
  EXPECT_NEAR((table[6].change - Eigen::Vector2d(0.05, 0.03)).norm(), 0, 1e-15);
}

TEST(Turns, RotateRightLeftOrNot) {
  const Turns turns(0.2, 1.5, growth_over(1.5, 0.3, 0.3));
  for (int a = 0; a < 3; ++a) {
    const ActionOutcome out = turns.after(level_camera(0.5), a);
    EXPECT_NEAR(heading_of(Eigen::Vector4d(out.state.segment<4>(3))), 0.5 + turns.rate_of(a) * 1.5, 1e-9);
    EXPECT_NEAR((out.state.head<3>() - Eigen::Vector3d(1.15, 2.3, 1.2)).norm(), 0, 1e-12) << "it flies on";
  }
  EXPECT_LT(turns.rate_of(0), 0);
  EXPECT_GT(turns.rate_of(1), 0);
  EXPECT_EQ(turns.rate_of(turns.stay()), 0);
}

/// On a level or tilted plane (6.10) is exact for a camera on a vehicle.
TEST(SpeedChanges, PredictTheCameraOfAVehicleOnAPlane) {
  const Mount mount{0.3, 0.1, 0.6, 0.2, 0.4};
  for (const auto& [slope_x, slope_y] : {std::pair{0.0, 0.0}, std::pair{0.3, -0.2}}) {
    const TerrainVehicle vehicle{TiltedPlane{0, slope_x, slope_y}};
    Eigen::Vector3d pose(1, -2, 0.7);
    const auto camera_at = [&](const Eigen::Vector3d& p) { return mount.on(vehicle.pose(p)).camera; };
    BlockVector state(15);
    state << camera_at(pose), 0.4, 0.2;
    const SpeedChanges moves(table_6_1(0.5, 0.3, 0.2), 1, growth_over(1, 0.3, 0.3), {}, mount, 2, 2);
    for (int a = 0; a < moves.count(); ++a) {
      const Eigen::Vector2d speeds = moves.after(Eigen::Vector2d(0.4, 0.2), a);
      Eigen::Vector3d moved = pose;
      for (int i = 0; i < 1000; ++i) moved = vehicle.f<double>(moved, speeds, 1e-3);
      const ActionOutcome out = moves.after(state, a);
      const FreeCameraMotion::State<double> wanted = camera_at(moved);
      EXPECT_NEAR((out.state.head<3>() - wanted.head<3>()).norm(), 0, 1e-9) << moves.actions()[a].name;
      EXPECT_NEAR(std::abs(Eigen::Vector4d(out.state.segment<4>(3)).dot(wanted.segment<4>(3))), 1, 1e-12);
      EXPECT_EQ(Eigen::Vector2d(out.state.tail<2>()), speeds);
    }
  }
}

TEST(SpeedChanges, RespectTheLimitsOfTheVehicle) {
  const SpeedChanges moves(table_6_1(5, 3, 1), 1, growth_over(1, 0.3, 0.3), {}, {}, 1, 0.5);
  EXPECT_EQ(moves.after(Eigen::Vector2d(0.5, 0), 6), Eigen::Vector2d(1, 0.5));
  EXPECT_EQ(moves.after(Eigen::Vector2d(0.5, 0), 5), Eigen::Vector2d(-1, -0.5));
}

}  // namespace
}  // namespace incognita
