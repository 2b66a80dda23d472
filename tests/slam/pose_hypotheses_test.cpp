// P3P with RANSAC finds the pose of a camera among false matches, and none where there is none.
#include <gtest/gtest.h>

#include <cmath>

#include "incognita/slam/features/pose_hypotheses.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

/// Landmarks in the volume that the camera sees, and their pixels with noise.
struct HypothesesScene {
  CameraState truth;
  std::vector<PointMatch> matches;
  RandomStream random;

  HypothesesScene(std::uint64_t seed, int count, double sigma_px = 0.5)
      : truth(camera_at({0.3, -0.2, 1.1}, 0.7, {0.1, -0.2, 0.3})), random(seed, "scene") {
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d pixel(random.uniform(10, 310), random.uniform(10, 230));
      const double depth_m = random.uniform(1, 4);
      PointMatch match;
      match.id = i;
      match.point = truth.head<3>() + rotation_matrix<double>(free_camera::orientation(truth)) *
                                          (depth_m * *camera.unproject(pixel));
      match.pixel = pixel + sigma_px * Eigen::Vector2d(random.normal(), random.normal());
      match.first_view = truth.head<3>();
      match.cov = 1e-6 * Eigen::Matrix3d::Identity();
      matches.push_back(match);
    }
  }
  /// Puts this many pixels elsewhere.
  void falsify(int count) {
    for (int i = 0; i < count; ++i)
      matches[static_cast<std::size_t>(i)].pixel = {random.uniform(10, 310), random.uniform(10, 230)};
  }
};

TEST(PoseHypotheses, FindsThePoseAmongHalfFalseMatches) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    HypothesesScene scene(seed, 30);
    scene.falsify(15);
    RandomStream random(seed, "ransac");
    const auto poses = find_poses(scene.matches, camera, {}, 0.5, random);
    ASSERT_FALSE(poses.empty()) << seed;
    const Eigen::Matrix<double, 6, 1> e = camera_error(scene.truth, poses[0].camera).head<6>();
    EXPECT_LT(e.head<3>().norm(), 0.03) << seed;
    EXPECT_LT(e.tail<3>().norm(), 0.015) << seed;
    EXPECT_LT(e.dot(poses[0].cov.llt().solve(e)), 30) << seed << ": 6 degrees of freedom";
    EXPECT_GE(poses[0].matches.size(), 13u) << seed;
    for (const int i : poses[0].matches) EXPECT_LT(scene.matches[static_cast<std::size_t>(i)].pixel.x(), 320);
  }
}

/// One match in ten is right. The right ones are among the more alike half, and half of the distinctive ones are right.
TEST(PoseHypotheses, FindsThePoseByAlikeAndDistinctiveMatches) {
  int found = 0;
  constexpr int seeds = 20;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    HypothesesScene scene(seed, 100);
    for (int i = 0; i < 100; ++i) {
      PointMatch& match = scene.matches[static_cast<std::size_t>(i)];
      const bool is_right = i < 50 && i % 5 == 0;
      match.is_distinctive = i < 50 && (i % 10 == 0 || i % 10 == 3);
      if (!is_right) match.pixel = {scene.random.uniform(10, 310), scene.random.uniform(10, 230)};
    }
    RandomStream random(seed, "ransac");
    const auto poses = find_poses(scene.matches, camera, {}, 0.5, random);
    found += !poses.empty() && (poses[0].camera - scene.truth).head<3>().norm() < 0.05;
  }
  EXPECT_GE(found, 15);
}

TEST(PoseHypotheses, ExplainsFewOfRandomMatches) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    HypothesesScene scene(seed, 30);
    scene.falsify(30);
    RandomStream random(seed, "ransac");
    for (const PoseHypothesis& pose : find_poses(scene.matches, camera, {}, 0.5, random))
      EXPECT_LT(pose.matches.size(), 8u) << seed;
  }
}

TEST(PoseHypotheses, AreTheSameForTheSameSeed) {
  HypothesesScene scene(5, 30);
  scene.falsify(20);
  RandomStream one(3, "ransac"), other(3, "ransac");
  const auto a = find_poses(scene.matches, camera, {}, 0.5, one),
             b = find_poses(scene.matches, camera, {}, 0.5, other);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].camera, b[i].camera);
}

TEST(PoseHypotheses, CountLandmarksAndPixelsOnce) {
  HypothesesScene scene(7, 6);
  const std::vector<PointMatch> six = scene.matches;
  for (int copy = 0; copy < 5; ++copy) scene.matches.insert(scene.matches.end(), six.begin(), six.end());
  RandomStream random(1, "ransac");
  for (const PoseHypothesis& pose : find_poses(scene.matches, camera, {}, 0.5, random))
    EXPECT_LE(pose.matches.size(), 6u);
}

TEST(PoseHypotheses, NoneFromMatchesThatTellOfOppositeDirections) {
  HypothesesScene scene(9, 12);
  for (int i = 0; i < 12; ++i)
    scene.matches[static_cast<std::size_t>(i)].expected = camera_at(
        scene.truth.head<3>(), 2 * M_PI / 3 * (i % 6));  // at most two agree with each other's direction
  PoseLimits limits;
  limits.min_matches = 4;
  RandomStream random(1, "ransac");
  EXPECT_TRUE(find_poses(scene.matches, camera, limits, 0.5, random).empty() ||
              find_poses(scene.matches, camera, limits, 0.5, random)[0].matches.size() <= 4u);
}

TEST(PoseHypotheses, NothingWithoutMatches) {
  RandomStream random(1, "ransac");
  EXPECT_TRUE(find_poses({}, camera, {}, 0.5, random).empty());
}

}  // namespace
}  // namespace incognita
