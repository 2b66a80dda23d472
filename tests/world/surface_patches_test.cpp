// The surfaces of the rendered room in patches, and the points of them that pixels show.
#include "incognita/world/rendered/surface_patches.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <stdexcept>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/rendered/room_ray.hpp"
#include "incognita/world/rendered/seen_surface.hpp"

namespace incognita {
namespace {

constexpr double camera_clearance_m = 0.15;

std::shared_ptr<const Room> room_of(int boxes, const Eigen::Vector3d& size_m = {4, 4, 2}) {
  RoomSettings settings;
  settings.size_m = size_m;
  settings.boxes = boxes;
  settings.texel_m = 0.02;  // coarse, to be painted fast
  return std::make_shared<const Room>(settings, 3);
}

double sum(const std::vector<double>& areas) { return std::accumulate(areas.begin(), areas.end(), 0.0); }

TEST(SurfacePatches, AnEmptyRoomHasThePatchesOfItsWallsFloorAndCeiling) {
  const auto room = room_of(0);
  const SurfacePatches patches(room, free_camera_positions(*room, camera_clearance_m), 1);
  ASSERT_EQ(patches.areas_m2().size(), 4u * 4 * 2 + 2 * 4 * 4);
  const double sheet_m2 = 0.70 * 0.56;
  EXPECT_NEAR(sum(patches.areas_m2()), 64 - sheet_m2, 0.1);
  int whole = 0;
  for (const double area_m2 : patches.areas_m2()) whole += std::abs(area_m2 - 1) < 1e-12;
  EXPECT_EQ(whole, 62) << "the sheet hangs across two of them";
}

TEST(SurfacePatches, SidesAreNearToTheGivenSize) {
  const auto room = room_of(0, {4.2, 3.4, 1.9});
  const auto count = [&](double size_m) {
    return SurfacePatches(room, free_camera_positions(*room, camera_clearance_m), size_m).areas_m2().size();
  };
  EXPECT_EQ(count(1), 2u * (4 * 3 + 4 * 2 + 3 * 2));
  EXPECT_EQ(count(0.5), 2u * (8 * 7 + 8 * 4 + 7 * 4) - 1) << "one is hidden by the sheet";
  EXPECT_THROW(SurfacePatches(room, {}, 0), std::invalid_argument);
}

TEST(SurfacePatches, APointBelongsToThePatchOnWhichItLies) {
  const auto room = room_of(0);
  const SurfacePatches patches(room, free_camera_positions(*room, camera_clearance_m), 1);
  const auto left_wall = patches.patch_at({0.3, 2, 0.4});
  ASSERT_TRUE(left_wall);
  EXPECT_EQ(patches.patch_at({0.9, 2, 0.9}), left_wall);
  EXPECT_NE(patches.patch_at({1.1, 2, 0.4}), left_wall);
  EXPECT_NE(patches.patch_at({0.3, 2, 1.1}), left_wall);
  EXPECT_NE(patches.patch_at({0.3, -2, 0.4}), left_wall);
  std::set<std::size_t> all;
  for (double x = -1.5; x < 2; ++x)
    for (double y = -1.5; y < 2; ++y)
      for (const double z : {0.0, 2.0}) all.insert(patches.patch_at({x, y, z}).value());
  EXPECT_EQ(all.size(), 32u);
  EXPECT_EQ(patches.patch_at({0.3, 1.9, 0.4}), std::nullopt) << "10 cm before the wall";
  EXPECT_EQ(patches.patch_at({0.3, 2.1, 0.4}), std::nullopt) << "behind it";
  EXPECT_EQ(patches.patch_at({2, 0.1, 1.3}), std::nullopt) << "on the sheet of the target";
  EXPECT_TRUE(patches.patch_at({2, 0.5, 1.3})) << "beside it";
}

TEST(SurfacePatches, WhatBoxesHideDoesNotCount) {
  const auto room = room_of(4, {6, 6, 2.5});
  const SurfacePatches patches(room, free_camera_positions(*room, camera_clearance_m), 0.1);
  for (const Box& box : room->layout().boxes) {
    const Eigen::Vector3d middle = 0.5 * (box.min + box.max);
    EXPECT_EQ(patches.patch_at({middle.x(), middle.y(), 0}), std::nullopt) << "the floor under a box";
    EXPECT_TRUE(patches.patch_at({middle.x(), middle.y(), box.max.z()})) << "its top";
    for (int axis = 0; axis < 2; ++axis)
      for (const bool upper : {false, true}) {
        Eigen::Vector3d side = middle;
        side[axis] = (upper ? box.max : box.min)[axis];
        const bool on_wall = std::abs(std::abs(side[axis]) - 3) < 1e-9;
        EXPECT_EQ(patches.patch_at(side).has_value(), !on_wall) << side.transpose();
      }
  }
}

TEST(SurfacePatches, ACameraOnAVehicleDoesNotSeeTheTopsOfHighBoxes) {
  const auto room = room_of(6, {6, 6, 2.5});
  Mount mount;
  mount.up_m = 0.8;
  const SurfacePatches patches(room, carried_camera_positions(*room, mount, 0.3), 0.3);
  int high = 0;
  for (const Box& box : room->layout().boxes) {
    Eigen::Vector3d top = 0.5 * (box.min + box.max);
    top.z() = box.max.z();
    const bool is_high = box.max.z() > mount.up_m;
    EXPECT_TRUE(!is_high || !patches.patch_at(top)) << top.transpose();
    high += is_high;
  }
  EXPECT_GT(high, 0);
}

TEST(SurfacePatches, OnUnevenGroundAPointLiesAtItsHeight) {
  const Terrain terrain{Waves{0, {{0.1, 3, 0.3, 0}}}};
  RoomSettings settings;
  settings.boxes = 0;
  settings.texel_m = 0.02;
  const auto room = std::make_shared<const Room>(settings, 3, terrain);
  Mount mount;
  mount.up_m = 0.8;
  const SurfacePatches patches(room, carried_camera_positions(*room, mount, 0.3), 0.5);
  const Eigen::Vector3d point = surface_point(*room, {0.4, 0.2, 1}, {0.1, 0.2, -1});
  EXPECT_NE(point.z(), 0);
  EXPECT_TRUE(patches.patch_at(point));
  EXPECT_EQ(patches.patch_at(point + Eigen::Vector3d(0, 0, 0.01)), std::nullopt);
}

BodyTruth body_at(const Eigen::Vector3d& position, double heading_rad) {
  BodyTruth body;
  body.pose = RigidPose{position, level_gaze(heading_rad)};
  return body;
}

TEST(SeenSurface, APixelShowsWhereItsTrueRayMeetsTheRoom) {
  WideAngleCamera lens;
  lens.width = 320, lens.height = 240;
  lens.fu = lens.fv = 200;
  lens.u0 = 160, lens.v0 = 120;
  const SeenSurface seen(room_of(0), lens, 0);
  const BodyTruth body = body_at({0.5, 0.25, 1}, 0);
  const auto middle = seen.at({160, 120}, body, Tick{0, 0, 0});
  ASSERT_TRUE(middle);
  EXPECT_NEAR((*middle - Eigen::Vector3d(2, 0.25, 1)).norm(), 0, 1e-9);
  const auto right_below = seen.at({200, 160}, body, Tick{0, 0, 0});
  ASSERT_TRUE(right_below);
  EXPECT_NEAR((*right_below - Eigen::Vector3d(2, 0.25 - 0.3, 1 - 0.3)).norm(), 0, 1e-9);
  EXPECT_EQ(seen.at({160, 120}, BodyTruth{}, Tick{0, 0, 0}), std::nullopt) << "no true pose";
  EXPECT_EQ(seen.at({160, 120}, body_at({2.5, 0, 1}, 0), Tick{0, 0, 0}), std::nullopt) << "outside";
}

TEST(SeenSurface, OfARollingShutterFromThePoseAtThatRow) {
  WideAngleCamera lens;
  lens.width = 320, lens.height = 240;
  lens.fu = lens.fv = 200;
  lens.u0 = 160, lens.v0 = 119.5;
  const double readout_s = 0.02, speed_m_s = 2;
  const PoseAtTime sideways = [=](double t) { return RigidPose{{0, speed_m_s * t, 1}, level_gaze(0.0)}; };
  const SeenSurface seen(room_of(0), lens, readout_s, sideways);
  const BodyTruth body = body_at({0, 0.2, 1}, 0);
  const Tick tick{3, 0.1, 0.1};
  const double later_s = row_time_s(179.5, 240, readout_s);
  EXPECT_NEAR(later_s, 0.25 * readout_s, 1e-12);
  EXPECT_NEAR(seen.at({160, 119.5}, body, tick)->y(), 0.2, 1e-9);
  EXPECT_NEAR(seen.at({160, 179.5}, body, tick)->y(), 0.2 + speed_m_s * later_s, 1e-9);
}

}  // namespace
}  // namespace incognita
