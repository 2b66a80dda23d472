// A person drives: free cameras follow a moving reference, vehicles get shares of their limits, operators are shown
// segments.
#include "incognita/control/manual_control.hpp"

#include <gtest/gtest.h>

#include "incognita/models/any_motion.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

/// The camera itself moves without noise, driven for `s` seconds at 30 Hz.
CameraState flown(const ManualDrive& drive, double s, double heading_rad = 0.5) {
  ManualFlight flight;
  const FreeCameraMotion motion;
  SmallVector state = at_rest(motion, {1, 2, 1}, heading_rad);
  constexpr double dt = 1.0 / 30;
  for (int k = 0; k * dt < s; ++k)
    state = step_of(motion, state, flight.act(CameraState(state), drive, k * dt, {}), dt).x;
  return CameraState(state);
}

TEST(ManualFlight, HoldsStill) {
  const CameraState end = flown({}, 5);
  EXPECT_LT((free_camera::position(end) - Eigen::Vector3d(1, 2, 1)).norm(), 1e-9);
  EXPECT_NEAR(heading_of(free_camera::orientation(end)), 0.5, 1e-9);
}

TEST(ManualFlight, GoesAheadLeftAndUpRelativeToTheHeading) {
  const Eigen::Vector3d ahead(std::cos(0.5), std::sin(0.5), 0), left(-ahead.y(), ahead.x(), 0);
  const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> cases{
      {{1, 0, 0}, ahead}, {{0, 1, 0}, left}, {{0, 0, -1}, {0, 0, -1}}};
  for (const auto& [direction, world] : cases) {
    const CameraState end = flown({direction, 0}, 4);
    EXPECT_NEAR((free_camera::velocity(end) - manual_speed_m_s * world).norm(), 0, 0.02);
    EXPECT_NEAR((free_camera::position(end) - Eigen::Vector3d(1, 2, 1)).dot(world), 4 * manual_speed_m_s,
                0.2);
  }
}

TEST(ManualFlight, TurnsLeft) {
  const double turned = heading_of(free_camera::orientation(flown({{0, 0, 0}, 1}, 2))) - 0.5;
  EXPECT_NEAR(turned, 2 * manual_turn_rate_rad_s, 0.1);
}

TEST(ManualDisplay, ShowsASegmentAtATimeAndNothingAtRest) {
  ManualDisplay display;
  const CameraState state(at_rest(FreeCameraMotion{}, {0, 0, 1}, 0));
  EXPECT_FALSE(display.show(state, {}, 0));
  const ManualDrive left{{0, 1, 0}, 0};
  const auto first = display.show(state, left, 0);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->is_new);
  EXPECT_GT(first->segment.to.y(), 0.1);
  EXPECT_FALSE(display.show(state, left, 0.1)->is_new);
  EXPECT_TRUE(display.show(state, left, 0.6)->is_new);
  EXPECT_FALSE(display.show(state, {}, 0.7));
}

TEST(ManualInput, IsAShareOfTheLimits) {
  const SmallVector most = Eigen::Vector2d(2, 0.5);
  EXPECT_EQ(manual_input({{0.5, 1, 1}, -1}, most), SmallVector(Eigen::Vector2d(1, -0.5)));
  EXPECT_EQ(manual_input({{-1, 0, 0}, 1}, SmallVector::Ones(1)), SmallVector(-SmallVector::Ones(1)));
  EXPECT_EQ(manual_input({{1, 0, 0}, 1}, SmallVector()).size(), 0);
}

}  // namespace
}  // namespace incognita
