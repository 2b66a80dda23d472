// A whole run as one bundle: its landmarks begin where their rays intersect, and adjustment finds the true views.
#include "incognita/slam/bundle/run_bundle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/bundle/adjust_bundle.hpp"

namespace incognita {
namespace {

const Camera run_camera{WideAngleCamera{}};
constexpr int views = 12, landmarks = 40;
constexpr double noise_px = 0.05;

/// A camera moves sideways past points; the run's estimate of it drifts.
struct DriftingRun {
  std::vector<BundleView> truth;
  RunMatches matches;
  std::vector<Eigen::Vector3d> points;

  explicit DriftingRun(std::uint64_t seed) {
    RandomStream random(seed, "run");
    for (int i = 0; i < landmarks; ++i)
      points.emplace_back(random.uniform(-0.6, 1.7), random.uniform(-0.7, 0.7), random.uniform(1.5, 3));
    for (int k = 0; k < views; ++k) {
      truth.push_back({{0.1 * k, 0.02 * random.normal(), 0.02 * random.normal()}, {1, 0, 0, 0}});
      BundleView drifted = truth.back();
      drifted.position += 0.004 * k * Eigen::Vector3d(1, -0.5, 0.5);
      drifted.world_from_camera = quaternion_exp<double>(0.002 * k * Eigen::Vector3d(0.5, 1, 0.2));
      matches.views.push_back(drifted);
      for (int i = 0; i < landmarks; ++i) {
        const auto pixel = run_camera.project(points[static_cast<std::size_t>(i)] - truth.back().position);
        if (!pixel || !run_camera.contains(pixel->pixel, 0)) continue;
        matches.pixels[i].emplace_back(
            k, pixel->pixel + noise_px * Eigen::Vector2d(random.normal(), random.normal()));
      }
    }
  }
  double worst_position_m(const std::vector<BundleView>& of, double scale) const {
    double worst = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
      worst = std::max(
          worst,
          (scale * (of[k].position - of[0].position) - (truth[k].position - truth[0].position)).norm());
    return worst;
  }
  /// That takes the last view of `of` as far from the first as it is.
  double scale_of(const std::vector<BundleView>& of) const {
    return (truth.back().position - truth.front().position).norm() /
           (of.back().position - of.front().position).norm();
  }
};

std::vector<BundleView> adjusted(const RunMatches& matches) {
  Bundle bundle = bundle_of(matches, run_camera, noise_px);
  BundleEquations equations;
  AdjustmentSettings settings;
  settings.max_iterations = 100;
  EXPECT_NE(adjust(bundle, run_camera, settings, equations).outcome, AdjustmentReport::Outcome::refused);
  std::vector<double> residuals = residuals_px(bundle, run_camera);
  EXPECT_LT(*std::ranges::max_element(residuals), 5 * noise_px);
  return bundle.views;
}

TEST(RunBundle, FindsTheViewsUpToScale) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const DriftingRun run(seed);
    EXPECT_GT(run.worst_position_m(run.matches.views, run.scale_of(run.matches.views)), 0.01) << "the drift";
    const std::vector<BundleView> found = adjusted(run.matches);
    EXPECT_LT(run.worst_position_m(found, run.scale_of(found)), 0.005) << seed;
  }
}

TEST(RunBundle, FindsTheScaleOfAnchors) {
  DriftingRun run(1);
  for (int i = 0; i < 8; ++i) run.matches.known[i] = run.points[static_cast<std::size_t>(i)];
  EXPECT_LT(run.worst_position_m(adjusted(run.matches), 1), 0.005);
}

TEST(RunBundle, HasLandmarksOfThreeMatchesWhereTheirRaysIntersect) {
  DriftingRun run(1);
  run.matches.views = run.truth;
  run.matches.pixels[0].resize(2);
  run.matches.pixels[1].resize(3);
  const Bundle bundle = bundle_of(run.matches, run_camera, noise_px);
  EXPECT_EQ(bundle.points.size(), landmarks - 1u);
  int near = 0;
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    const double depth_m =
        run.points[i + 1].z() - run.truth[static_cast<std::size_t>(bundle.points[i].host)].position.z();
    near += std::abs(bundle.points[i].value[2] * depth_m - 1) < 0.05;
  }
  EXPECT_GE(near, landmarks - 4);
}

/// Of a landmark without parallax the depth begins at the median of the others.
TEST(RunBundle, GivesLandmarksWithoutParallaxTheDepthOfTheOthers) {
  DriftingRun run(1);
  run.matches.views = run.truth;
  for (auto& [view, pixel] : run.matches.pixels[3])
    pixel = run_camera.project(Eigen::Vector3d(0, 0, 1))->pixel;
  const Bundle bundle = bundle_of(run.matches, run_camera, noise_px);
  EXPECT_GT(1 / bundle.points[3].value[2], 1.5);
  EXPECT_LT(1 / bundle.points[3].value[2], 3);
}

}  // namespace
}  // namespace incognita
