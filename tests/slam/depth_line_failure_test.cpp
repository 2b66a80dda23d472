// When a depth line is given up (thesis C.3): not found too often, or found where no hypothesis is.
#include <Eigen/LU>
#include <cmath>

#include "tests/slam/depth_line_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;
using Scene = DepthLineScene;

TEST(DepthLine, IsGivenUpAfterTooManyFailuresInARow) {
  Scene scene;
  scene.settings().initialization.max_line_failures = 4;
  scene.settings().initialization.depth_ratio = 1e-6;
  const Wall other(2, 99);
  for (int k = 1; k <= 3; ++k) {
    scene.follow(aside(0.02), other);
    ASSERT_EQ(scene.estimate.landmarks.size(), 1u);
    EXPECT_EQ(scene.matches().at(0).outcome, MatchOutcome::not_found);
    EXPECT_EQ(scene.appearance().ray_failures, k);
    EXPECT_EQ(scene.appearance().depths.size(), 100u) << "a failure says nothing of the depth";
  }
  scene.follow(aside(0.02));
  ASSERT_EQ(scene.matches().at(0).outcome, MatchOutcome::matched);
  for (int k = 1; k <= 3; ++k) scene.follow(aside(0.02), other);
  ASSERT_EQ(scene.estimate.landmarks.size(), 1u) << "the match began the count anew";
  scene.follow(aside(0.02), other);
  EXPECT_TRUE(scene.estimate.landmarks.empty());
  EXPECT_EQ(scene.estimate.belief.errors(), 12) << "and its block is gone";
}

/// Out of view is a failure too, or it would be followed for ever.
TEST(DepthLine, OutOfViewIsGivenUpToo) {
  Scene scene;
  scene.settings().initialization.max_line_failures = 3;
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(scene.estimate.landmarks.size(), 1u);
    scene.follow(camera_at({0, 0, 0}, M_PI));
    EXPECT_TRUE(scene.matches().empty());
  }
  EXPECT_TRUE(scene.estimate.landmarks.empty());
}

/// Found 12 sigmas from the only hypothesis: no depth on the line explains that.
TEST(DepthLine, IsDroppedWhenNoHypothesisExplainsTheMatch) {
  for (const bool right : {false, true}) {
    Scene scene(40, with_lines(), 1e-10 * CameraCov::Identity());
    scene.settings().search.gate_sigmas = 20;
    // Moved by 0.2 m: 19.5 px of parallax at 2 m, 6 px more at 1.53 m
    scene.appearance().depths = {{right ? 1 / 2.0 : 1 / 1.53, 1.0}};
    scene.follow(aside(0.2));
    ASSERT_EQ(scene.matches().size(), 1u);
    EXPECT_EQ(scene.matches()[0].outcome, right ? MatchOutcome::matched : MatchOutcome::outlier);
    EXPECT_EQ(scene.estimate.landmarks.size(), right ? 1u : 0u);
    EXPECT_EQ(scene.estimate.belief.errors(), right ? 15 : 12);
    if (!right) continue;
    // One hypothesis is left: its depth is uncertain by the spacing of the first ones, 4.5 m / 100
    const Eigen::Matrix3d P = scene.estimate.belief.covariance(scene.line().block);
    const Eigen::Vector3d along = scene.truth / scene.truth.x();
    EXPECT_NEAR(1 / std::sqrt(along.dot(P.inverse() * along)), 0.045 / std::sqrt(12), 1e-4);
  }
}

/// The gate is narrower than a pixel, and its nearest pixel may lie outside.
TEST(DepthLine, IsFoundBetweenPixels) {
  for (int k = 0; k < 12; ++k) {
    Scene scene(40, with_lines(0.1), 1e-10 * CameraCov::Identity());
    scene.appearance().depths = {{1 / 2.0, 1.0}};
    scene.follow(aside(0.2 + 0.002 * k));  // 0.2 px each
    ASSERT_EQ(scene.matches().size(), 1u);
    EXPECT_EQ(scene.matches()[0].outcome, MatchOutcome::matched) << k;
  }
}

/// Its peak lies beyond the gate, by a pixel that is tried because it is the nearest to peaks inside.
TEST(DepthLine, IsNotFoundOutsideOfItsGate) {
  int failures = 0;
  for (int k = 0; k < 12; ++k) {
    Scene scene(40, with_lines(0.1), 1e-10 * CameraCov::Identity());
    scene.appearance().depths = {{1 / 1.90, 1.0}};  // 1 px more of parallax
    scene.follow(aside(0.2 + 0.002 * k));
    ASSERT_EQ(scene.matches().size(), 1u);
    EXPECT_NE(scene.matches()[0].outcome, MatchOutcome::matched) << k;
    ASSERT_EQ(scene.estimate.landmarks.size(), 1u) << k << ": one failure of ten";
    failures += scene.appearance().ray_failures;
  }
  EXPECT_EQ(failures, 12);
}

TEST(DepthLine, LeavesOtherLandmarksAlone) {
  Scene scene;
  const Eigen::Vector3d at = wall.point_at(origin, {90, 90});
  const Landmark& point = scene.landmark(scene.add_point(wall.seen_from(origin), origin, at, at, 0.01));
  const Eigen::MatrixXd before = scene.estimate.belief.covariance(point.block);
  scene.settings().initialization.max_line_failures = 1;
  scene.follow(aside(0.02), Wall(2, 99));
  ASSERT_EQ(scene.estimate.landmarks.size(), 1u);
  EXPECT_EQ(point.form.kind, Kind::point);
  EXPECT_EQ(scene.estimate.belief.covariance(point.block), before);
  EXPECT_TRUE(scene.matches().size() == 1);
}

}  // namespace
}  // namespace incognita
