#include "incognita/analysis/evaluation/trajectory.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

Trajectory wandering(int count) {
  RandomStream random(7, "wandering");
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i;
    StampedPose pose{t, {std::sin(t), 2 * std::cos(0.7 * t), 0.5 * std::sin(1.3 * t)}, {1, 0, 0, 0}};
    pose.orientation =
        quaternion_exp<double>(Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    trajectory.push_back(pose);
  }
  return trajectory;
}

/// The estimate that this alignment transforms into the truth.
Trajectory undone(const Trajectory& truth, const Alignment& alignment) {
  const Alignment inverse{1 / alignment.scale, alignment.rotation.transpose(),
                          -alignment.rotation.transpose() * alignment.translation / alignment.scale};
  return aligned(truth, inverse);
}

void expect_recovered(AlignmentKind kind, const Alignment& known) {
  const Trajectory truth = wandering(60);
  const MatchedTrajectories matched = match(undone(truth, known), truth, 1e-6);
  ASSERT_EQ(matched.estimate.size(), 60u);
  EXPECT_GT(absolute_trajectory_error(matched).rmse, 0.1);
  const auto found = align(matched, kind);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale, known.scale, 1e-9);
  EXPECT_TRUE(found->rotation.isApprox(known.rotation, 1e-9)) << found->rotation;
  EXPECT_TRUE(found->translation.isApprox(known.translation, 1e-9)) << found->translation.transpose();
  const MatchedTrajectories after{aligned(matched.estimate, *found), matched.truth};
  EXPECT_LT(absolute_trajectory_error(after).max, 1e-9);
  EXPECT_LT(relative_pose_error(after, {1, 0}).translation_m.max, 1e-9);
  EXPECT_LT(relative_pose_error(after, {1, 0}).rotation_rad.max, 1e-7);
}

TEST(Align, RecoversAKnownRigidMotion) {
  expect_recovered(AlignmentKind::se3,
                   {1, rotation_exp<double>(Eigen::Vector3d(0.4, -1.1, 2.0)), {3, -2, 0.5}});
}

TEST(Align, RecoversAKnownScale) {
  expect_recovered(AlignmentKind::sim3,
                   {2.7, rotation_exp<double>(Eigen::Vector3d(-0.4, 0.3, 1.0)), {1, 2, 3}});
  expect_recovered(AlignmentKind::sim3, {0.02, rotation_exp<double>(Eigen::Vector3d(3.0, 0, 0)), {0, -1, 0}});
}

TEST(Align, RecoversAKnownHeading) {
  expect_recovered(AlignmentKind::yaw, {1, rotation_exp<double>(Eigen::Vector3d(0, 0, -2.5)), {3, -2, 0.5}});
}

TEST(Align, YawAlignmentDoesNotTilt) {
  const Trajectory truth = wandering(60);
  const Alignment tilt{1, rotation_exp<double>(Eigen::Vector3d(0.3, 0, 0)), {0, 0, 0}};
  const MatchedTrajectories matched = match(undone(truth, tilt), truth, 1e-6);
  const auto found = align(matched, AlignmentKind::yaw);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rotation(2, 2), 1, 1e-12);
  EXPECT_GT(absolute_trajectory_error({aligned(matched.estimate, *found), truth}).rmse, 0.05);
}

TEST(Align, MirroredTrajectoryStillGivesARotation) {
  const Trajectory truth = wandering(60);
  Trajectory mirrored = truth;
  for (StampedPose& pose : mirrored) pose.position.x() *= -1;
  const auto found = align({mirrored, truth}, AlignmentKind::se3);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rotation.determinant(), 1, 1e-9);
}

TEST(Align, RefusesAScaleWithoutMotion) {
  const Trajectory still(10, StampedPose{0, {1, 2, 3}, {1, 0, 0, 0}});
  EXPECT_FALSE(align({still, wandering(10)}, AlignmentKind::sim3));
  EXPECT_FALSE(align({wandering(10), still}, AlignmentKind::sim3));
  EXPECT_FALSE(align({}, AlignmentKind::se3));
  ASSERT_TRUE(align({still, still}, AlignmentKind::se3));
  EXPECT_LT(
      absolute_trajectory_error({aligned(still, *align({still, still}, AlignmentKind::se3)), still}).max,
      1e-12);
}

TEST(Associate, TakesTheNearestStampAndEachPoseOnce) {
  const auto at = [](std::initializer_list<double> times) {
    Trajectory trajectory;
    for (const double t : times) trajectory.push_back({t, {0, 0, 0}, {1, 0, 0, 0}});
    return trajectory;
  };
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(associate(at({0.0, 1.0, 2.0}), at({0.004, 0.996, 2.02}), 0.01), (Pairs{{0, 0}, {1, 1}}));
  EXPECT_EQ(associate(at({0.0, 0.003, 0.006}), at({0.004}), 0.01), (Pairs{{1, 0}}));
  EXPECT_EQ(associate(at({2.0, 0.0, 1.0}), at({1.0, 2.0}), 0.01), (Pairs{{2, 0}, {0, 1}}));  // unsorted
  // duplicate stamps
  EXPECT_EQ(associate(at({1.0, 1.0}), at({1.0, 1.0}), 0.01).size(), 1u);
  // duplicates do not end the search
  EXPECT_EQ(associate(at({0.0, 1.0, 2.0}), at({0.0, 0.0, 1.0, 1.0, 2.0}), 0.01).size(), 3u);
  EXPECT_EQ(associate(at({0.0, 0.0, 1.0, 1.0, 2.0}), at({0.0, 1.0, 2.0}), 0.01).size(), 3u);
  EXPECT_TRUE(associate({}, at({1.0}), 0.01).empty());
}

/// Along x at 1 m/s with one pose per second; the estimate is off by `errors` along y.
MatchedTrajectories off_by(const std::vector<double>& errors) {
  MatchedTrajectories matched;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto t = static_cast<double>(i);
    matched.truth.push_back({t, {t, 0, 0}, {1, 0, 0, 0}});
    matched.estimate.push_back({t, {t, errors[i], 0}, {1, 0, 0, 0}});
  }
  return matched;
}

TEST(AbsoluteTrajectoryError, MatchesHandComputedValues) {
  const ErrorStatistics ate = absolute_trajectory_error(off_by({0, 1, 2, 4}));
  EXPECT_EQ(ate.count, 4u);
  EXPECT_NEAR(ate.rmse, std::sqrt(21.0 / 4), 1e-12);
  EXPECT_NEAR(ate.mean, 1.75, 1e-12);
  EXPECT_NEAR(ate.median, 1.5, 1e-12);
  EXPECT_NEAR(ate.max, 4, 1e-12);
}

TEST(RelativePoseError, MatchesHandComputedValues) {
  const RelativePoseError by_time = relative_pose_error(off_by({0, 1, 2, 4}), {1, 0});  // steps of 1, 1, 2
  EXPECT_EQ(by_time.translation_m.count, 3u);
  EXPECT_NEAR(by_time.translation_m.rmse, std::sqrt(6.0 / 3), 1e-12);
  EXPECT_NEAR(by_time.translation_m.median, 1, 1e-12);
  EXPECT_NEAR(by_time.rotation_rad.max, 0, 1e-12);
  const RelativePoseError by_frames = relative_pose_error(off_by({0, 1, 2, 4}), {1, 2});  // steps of 2 and 3
  EXPECT_EQ(by_frames.translation_m.count, 2u);
  EXPECT_NEAR(by_frames.translation_m.max, 3, 1e-12);
  EXPECT_EQ(relative_pose_error(off_by({0, 1, 2, 4}), {1.5, 0}).translation_m.count, 0u);  // no such interval
}

TEST(RelativePoseError, IncludesRotation) {
  MatchedTrajectories matched = off_by({0, 0, 0});
  matched.estimate[2].orientation = quaternion_exp<double>(Eigen::Vector3d(0, 0, 0.2));
  const RelativePoseError error = relative_pose_error(matched, {1, 0});
  EXPECT_EQ(error.rotation_rad.count, 2u);
  EXPECT_NEAR(error.rotation_rad.max, 0.2, 1e-12);
  EXPECT_NEAR(error.rotation_rad.mean, 0.1, 1e-12);
  // a rotation error of the first frame rotates the relative translation
  matched.estimate[0].orientation = quaternion_exp<double>(Eigen::Vector3d(0, 0, 0.2));
  EXPECT_NEAR(relative_pose_error(matched, {1, 0}).translation_m.max, 2 * std::sin(0.1), 1e-12);
}

TEST(Statistics, OfAnEmptySampleAreZeroWithCountZero) { EXPECT_EQ(statistics({}).count, 0u); }

}  // namespace
}  // namespace incognita
