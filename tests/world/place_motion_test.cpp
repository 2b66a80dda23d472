#include "incognita/world/rendered/place_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

constexpr double clearance_m = 0.2;

/// Around a circle, looking outward, in a frame that is not the room's.
std::vector<TimedPose> circle(double radius_m) {
  std::vector<TimedPose> motion;
  for (double a = 0; a < 6.28; a += 0.05)
    motion.push_back(
        {a, {{70 + radius_m * std::cos(a), -20 + radius_m * std::sin(a), 5}, level_gaze(2 + a)}});
  return motion;
}

/// Distance outside of a box, negative inside.
double outside(const Box& box, const Eigen::Vector3d& p) {
  return (box.min - p).cwiseMax(p - box.max).maxCoeff();
}

void expect_clear(const std::vector<TimedPose>& motion, const MotionPlacement& placement,
                  const RoomLayout& layout) {
  for (std::size_t k = 0; k + 1 < motion.size(); ++k)
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
      const Eigen::Vector3d p = (1 - share) * placement.of(motion[k]).pose.position +
                                share * placement.of(motion[k + 1]).pose.position;
      EXPECT_LE(outside(layout.inside, p), -clearance_m + 1e-9) << p.transpose();
      for (const Box& box : layout.boxes) EXPECT_GE(outside(box, p), clearance_m - 1e-9) << p.transpose();
    }
}

TEST(PlaceMotion, KeepsItsSizeWhereItFits) {
  const RoomLayout layout = room_layout(RoomSettings{}, 1);
  const MotionPlacement placement = place_motion(circle(0.5), layout, clearance_m, {{0.5, 0.2, 1.3}, 0.3});
  EXPECT_EQ(placement.scale, 1);
  const RigidPose first = placement.of(circle(0.5).front()).pose;
  EXPECT_LT((first.position - Eigen::Vector3d(0.5, 0.2, 1.3)).norm(), 1e-9) << "nothing is in the way";
  EXPECT_NEAR(heading_of(first.world_from_body), 0.3, 1e-9);
  expect_clear(circle(0.5), placement, layout);
}

TEST(PlaceMotion, StaysClearOfWallsAndBoxes) {
  for (const int seed : {1, 2, 3})
    for (const double radius_m : {0.5, 1.5, 3.0, 20.0})
      for (const double heading : {0.0, 1.0, -2.5}) {
        const RoomLayout layout = room_layout(RoomSettings{.boxes = 8}, seed);
        const MotionPlacement placement =
            place_motion(circle(radius_m), layout, clearance_m, {{2.7, -2.7, 0.1}, heading});
        EXPECT_LE(placement.scale, 1);
        EXPECT_GT(placement.scale * radius_m, 0.4) << "the room has space for more";
        expect_clear(circle(radius_m), placement, layout);
      }
}

TEST(PlaceMotion, StaysFartherAwayWhereThereIsSpace) {
  const RoomLayout layout = room_layout(RoomSettings{.boxes = 0}, 1);
  const MotionPlacement placement = place_motion(circle(0.5), layout, clearance_m, {{2.8, 0, 1.3}, 0});
  EXPECT_EQ(placement.scale, 1);
  for (const TimedPose& pose : circle(0.5))
    EXPECT_LE(outside(layout.inside, placement.of(pose).pose.position), -0.4 - clearance_m);
}

TEST(PlaceMotion, ReturnsAShapeThatIsOnlyScaledAndTurned) {
  const std::vector<TimedPose> motion = circle(9);
  const MotionPlacement placement = place_motion(motion, room_layout(RoomSettings{}, 2), clearance_m, {});
  EXPECT_LT(placement.scale, 0.4);
  for (std::size_t k = 0; k < motion.size(); k += 7) {
    const TimedPose placed = placement.of(motion[k]), first = placement.of(motion[0]);
    EXPECT_EQ(placed.t, motion[k].t);
    EXPECT_NEAR((placed.pose.position - first.pose.position).norm(),
                placement.scale * (motion[k].pose.position - motion[0].pose.position).norm(), 1e-9);
    EXPECT_NEAR(placed.pose.position.z(), first.pose.position.z(), 1e-9)
        << "the vertical is that of the motion";
  }
}

TEST(PlaceMotion, RefusesWhatDoesNotFit) {
  EXPECT_THROW(place_motion({}, room_layout(RoomSettings{}, 1), clearance_m, {}), std::invalid_argument);
  EXPECT_THROW(place_motion(circle(500), room_layout(RoomSettings{}, 1), clearance_m, {}), UnfitSetting);
}

}  // namespace
}  // namespace incognita
