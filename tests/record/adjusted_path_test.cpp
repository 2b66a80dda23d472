// The trajectory after bundle adjustment, of a camera that moves along x at 1 m/s.
#include "incognita/record/summary/adjusted_path.hpp"

#include <gtest/gtest.h>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

StampedPose pose(double t, double x, double turn_rad = 0) {
  return {t, {x, 0, 0}, quaternion_exp<double>(Eigen::Vector3d(0, 0, turn_rad))};
}

Snapshot frame(const StampedPose& estimate) {
  Snapshot s;
  s.tick.t = estimate.t;
  s.bodies.emplace_back();
  s.bodies[0].state = TrackingState::tracking;
  s.bodies[0].estimate = estimate;
  return s;
}

Snapshot keyframe(const StampedPose& estimate, const StampedPose& before, const Trajectory& earlier) {
  Snapshot s = frame(estimate);
  s.keyframes = {before, earlier};
  s.keyframes->poses.push_back(estimate);
  return s;
}

void expect_same(const StampedPose& a, const StampedPose& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_TRUE(a.position.isApprox(b.position, 1e-12)) << a.t << ": " << a.position.transpose();
  EXPECT_TRUE(a.orientation.isApprox(b.orientation, 1e-12)) << a.t << ": " << a.orientation.transpose();
}

TEST(AdjustedPath, IsEmptyWithoutKeyframes) {
  AdjustedPath path;
  path.add(frame(pose(0, 0)));
  EXPECT_TRUE(path.trajectory().empty());
}

/// The filter drifts by 10 % and turns by 0.1 rad/s, and each keyframe puts it right.
TEST(AdjustedPath, SpreadsTheCorrectionOfAKeyframeOverTheFramesBeforeIt) {
  AdjustedPath path;
  path.add(frame(pose(0, 0)));
  path.add(frame(pose(1, 1.1, 0.1)));
  path.add(frame(pose(2, 2.2, 0.2)));
  path.add(keyframe(pose(4, 4), pose(4, 4.4, 0.4), {pose(0, 0)}));
  path.add(frame(pose(5, 5.1, 0.1)));
  path.add(keyframe(pose(6, 6), pose(6, 6.2, 0.2), {pose(0, 0), pose(4, 4)}));
  path.add(frame(pose(7, 7.1, 0.1)));
  const Trajectory adjusted = path.trajectory();
  ASSERT_EQ(adjusted.size(), 7u);
  for (const StampedPose& p : {adjusted[0], adjusted[1], adjusted[2], adjusted[3], adjusted[4], adjusted[5]})
    expect_same(p, pose(p.t, p.t));
  expect_same(adjusted[6], pose(7, 7.1, 0.1));  // no keyframe after it yet
}

/// It stands for 2 s and moves then, with a scale that the keyframe corrects.
TEST(AdjustedPath, DoesNotMoveACameraThatStood) {
  AdjustedPath path;
  for (const StampedPose& p : {pose(0, 0), pose(1, 0), pose(2, 0), pose(3, 1)}) path.add(frame(p));
  path.add(keyframe(pose(4, 3), pose(4, 2), {pose(0, 0)}));
  const Trajectory adjusted = path.trajectory();
  ASSERT_EQ(adjusted.size(), 5u);
  expect_same(adjusted[2], pose(2, 0));
  expect_same(adjusted[3], pose(3, 1.5));
}

/// The heading is corrected by 0.2 rad while the camera pitches: the axis of the correction stays that of the world.
TEST(AdjustedPath, CorrectsTheHeadingAboutTheVerticalOfTheWorld) {
  const auto pitched = [](double t, double heading_rad) {
    const Eigen::Vector4d heading = quaternion_exp<double>(Eigen::Vector3d(0, 0, heading_rad)),
                          pitch = quaternion_exp<double>(Eigen::Vector3d(0, t * t, 0));
    return StampedPose{t, {t, 0, 0}, quaternion_product(heading, pitch)};
  };
  AdjustedPath path;
  path.add(frame(pitched(0, 0)));
  path.add(frame(pitched(0.8, 0)));
  path.add(keyframe(pitched(1, 0.2), pitched(1, 0), {pitched(0, 0.2)}));
  const Trajectory adjusted = path.trajectory();
  ASSERT_EQ(adjusted.size(), 3u);
  for (const StampedPose& p : adjusted) expect_same(p, pitched(p.t, 0.2));
}

TEST(AdjustedPath, TakesAKeyframeAsItWasAdjustedLast) {
  AdjustedPath path;
  path.add(frame(pose(0, 0)));
  path.add(keyframe(pose(2, 2), pose(2, 2), {pose(0, 0)}));
  path.add(frame(pose(3, 3)));
  path.add(keyframe(pose(4, 4), pose(4, 4), {pose(0, 0), pose(2, 2.5)}));
  const Trajectory adjusted = path.trajectory();
  ASSERT_EQ(adjusted.size(), 4u);
  expect_same(adjusted[1], pose(2, 2.5));
  expect_same(adjusted[2], pose(3, 3.25));
  expect_same(adjusted[3], pose(4, 4));
}

/// Keyframes that begin anew, after the filter closed a loop: what it corrected there is no error of the frames before.
TEST(AdjustedPath, DoesNotSpreadWhatNoKeyframeCorrected) {
  AdjustedPath path;
  path.add(frame(pose(0, 0)));
  path.add(keyframe(pose(1, 1), pose(1, 1), {pose(0, 0)}));
  path.add(frame(pose(2, 2)));
  path.add(frame(pose(3, 9)));  // the first of the new keyframes
  path.add(keyframe(pose(4, 10), pose(4, 10), {pose(3, 9)}));
  const Trajectory adjusted = path.trajectory();
  ASSERT_EQ(adjusted.size(), 5u);
  expect_same(adjusted[2], pose(2, 2));
  expect_same(adjusted[3], pose(3, 9));
}

TEST(AdjustedPath, LeavesOutFramesWithoutAPose) {
  AdjustedPath path;
  path.add(frame(pose(0, 0)));
  Snapshot lost = frame(pose(1, 1));
  lost.bodies[0].state = TrackingState::lost;
  path.add(lost);
  path.add(keyframe(pose(2, 2), pose(2, 2), {pose(0, 0)}));
  EXPECT_EQ(path.trajectory().size(), 2u);
}

}  // namespace
}  // namespace incognita
