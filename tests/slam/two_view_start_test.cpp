// Other starts of bundle adjustment, from the relative pose of two views and from no motion, where the filter went wrong.
#include "incognita/slam/bundle/two_view_start.hpp"

#include <limits>

#include "incognita/slam/bundle/adjust_bundle.hpp"
#include "incognita/slam/bundle/flat_start.hpp"
#include "incognita/slam/bundle/relative_pose.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

const CameraState first_camera = camera_at({0, 0, 1});

struct Motion {
  const char* name;
  Eigen::Vector3d shift;  // m, world; the camera looks along x
  Eigen::Vector3d turn;   // rad, camera axes
};

const std::vector<Motion> motions = {{"forward", {0.4, 0, 0}, {0, 0, 0}},
                                     {"sideways", {0, 0.3, 0}, {0, 0, 0}},
                                     {"forward with a turn", {0.4, 0.1, 0}, {0.01, 0.15, -0.02}},
                                     {"backward", {-0.3, 0, 0.05}, {0, -0.05, 0.2}}};

/// `detour`: m, world, how far the camera is from the line half way.
CameraState moved(const Motion& motion, double share, const Eigen::Vector3d& detour = {0, 0, 0}) {
  const Eigen::Vector3d shift = share * motion.shift + 4 * share * (1 - share) * detour;
  return camera_at(shift + Eigen::Vector3d(0, 0, 1), 0, share * motion.turn);
}

std::vector<Eigen::Vector3d> scattered_points(int count) {
  RandomStream random(3, "points");
  std::vector<Eigen::Vector3d> points;
  while (static_cast<int>(points.size()) < count)
    points.emplace_back(random.uniform(1.5, 5), random.uniform(-1.5, 1.5), random.uniform(0.2, 1.8));
  return points;
}

/// Views at `0, 1/steps, ... 1` of the motion as a wrong filter has them: all where the first is, all depths alike.
Bundle wrong_bundle(const Motion& motion, int steps, double noise_px, int outliers,
                    const Eigen::Vector3d& detour = {0, 0, 0}) {
  RandomStream random(5, "noise");
  Bundle bundle;
  for (int k = 0; k <= steps; ++k)
    bundle.views.push_back({first_camera.head<3>(), first_camera.segment<4>(3), k == 0});
  for (const Eigen::Vector3d& at : scattered_points(60)) {
    BundlePoint point;
    point.kind = BundlePoint::Kind::inverse_depth;
    point.host = 0;
    point.initial_axes = first_camera.segment<4>(3);
    point.prior_inverse_depth = point.sigma_prior_inverse_depth = 0.5;
    const auto ray = camera.unproject(pixel_of(first_camera, at));
    point.value << ray->x(), ray->y(), 0.5;
    const int index = static_cast<int>(bundle.points.size());
    for (int k = 0; k <= steps; ++k) {
      Eigen::Vector2d pixel = pixel_of(moved(motion, static_cast<double>(k) / steps, detour), at);
      pixel += noise_px * Eigen::Vector2d(random.normal(), random.normal());
      if (k == steps && index < outliers) pixel += Eigen::Vector2d(30, -20);
      bundle.observations.push_back({k, index, pixel, 0.25 * Eigen::Matrix2d::Identity()});
    }
    bundle.points.push_back(point);
  }
  return bundle;
}

TEST(RelativePose, IsThatOfTheRays) {
  for (const Motion& motion : motions) {
    const CameraState second_camera = moved(motion, 1);
    std::vector<Eigen::Vector3d> a, b;
    for (const Eigen::Vector3d& at : scattered_points(40)) {
      a.push_back(*camera.unproject(pixel_of(first_camera, at)));
      b.push_back(*camera.unproject(pixel_of(second_camera, at)));
    }
    const auto pose = relative_pose(a, b, 1e-3);
    ASSERT_TRUE(pose) << motion.name;
    const Eigen::Matrix3d world_from_first = rotation_matrix<double>(free_camera::orientation(first_camera));
    const Eigen::Vector3d shift =
        world_from_first.transpose() * (second_camera.head<3>() - first_camera.head<3>());
    EXPECT_GT(pose->direction.dot(shift.normalized()), 1 - 1e-6) << motion.name;
    const Eigen::Matrix3d turn =
        world_from_first.transpose() * rotation_matrix<double>(free_camera::orientation(second_camera));
    EXPECT_TRUE(rotation_matrix<double>(pose->first_from_second).isApprox(turn, 1e-5)) << motion.name;
  }
}

TEST(RelativePose, NeedsEnoughRays) {
  const std::vector<Eigen::Vector3d> few(7, Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(relative_pose(few, few, 1e-3));
}

void expect_last_view(const Bundle& bundle, const Motion& motion, double direction_rad, double turn_rad) {
  const Eigen::Vector3d shift = bundle.views.back().position - Eigen::Vector3d(first_camera.head<3>());
  EXPECT_GT(shift.normalized().dot(motion.shift.normalized()), std::cos(direction_rad)) << motion.name;
  const CameraState truth = moved(motion, 1);
  const Eigen::Vector4d error = quaternion_product<double>(
      quaternion_conjugate<double>(free_camera::orientation(truth)), bundle.views.back().world_from_camera);
  EXPECT_LT(quaternion_log<double>(error).norm(), turn_rad) << motion.name;
}

TEST(TwoViewStart, IsNearTheTruthDespiteNoiseAndOutliers) {
  for (const Motion& motion : motions) {
    const auto start = two_view_start(wrong_bundle(motion, 3, 0.3, 6), camera);
    ASSERT_TRUE(start) << motion.name;
    expect_last_view(*start, motion, 0.2, 0.03);
  }
}

TEST(TwoViewStart, LeadsAdjustmentToTheMinimum) {
  for (const Motion& motion : motions) {
    std::optional<Bundle> start = two_view_start(wrong_bundle(motion, 3, 0.3, 0), camera);
    ASSERT_TRUE(start) << motion.name;
    BundleEquations equations;
    adjust(*start, camera, {.max_iterations = 20}, equations);
    expect_last_view(*start, motion, 0.05, 0.01);
  }
}

/// On the line between the first and the last, views are up to 30 px from their matches.
TEST(TwoViewStart, FindsTheViewsBetweenWhereTheCameraMovedInABend) {
  const Eigen::Vector3d detour(0, 0.1, 0.2);
  for (const int outliers : {0, 6, 12}) {
    const auto start = two_view_start(wrong_bundle(motions[1], 4, 0.1, outliers, detour), camera);
    ASSERT_TRUE(start) << outliers;
    const Eigen::Vector3d origin_of_views = first_camera.head<3>();
    const double scale = (start->views.back().position - origin_of_views).norm() / motions[1].shift.norm();
    for (int k = 1; k < 4; ++k) {
      const Eigen::Vector3d truth = moved(motions[1], k / 4.0, detour).head<3>() - first_camera.head<3>();
      const Eigen::Vector3d found =
          (start->views[static_cast<std::size_t>(k)].position - origin_of_views) / scale;
      EXPECT_LT((found - truth).norm(), 0.02) << k << ", " << outliers << " outliers";
    }
  }
}

TEST(TwoViewStart, LeavesViewsOnTheLineThatSeeTooFewOfThePoints) {
  Bundle bundle = wrong_bundle(motions[1], 2, 0, 0, {0, 0, 0.2});
  std::erase_if(bundle.observations,
                [](const BundleObservation& seen) { return seen.view == 1 && seen.point >= 5; });
  const auto start = two_view_start(bundle, camera);
  ASSERT_TRUE(start);
  EXPECT_LT((2 * start->views[1].position - start->views[0].position - start->views[2].position).norm(),
            1e-12);
}

TEST(TwoViewStart, HasTheScaleOfThePriors) {
  const auto start = two_view_start(wrong_bundle(motions[1], 1, 0, 0), camera);
  ASSERT_TRUE(start);
  std::vector<double> inverse_depths;
  for (const BundlePoint& point : start->points) inverse_depths.push_back(point.value[2]);
  std::nth_element(inverse_depths.begin(), inverse_depths.begin() + 30, inverse_depths.end());
  EXPECT_NEAR(inverse_depths[30], 0.5, 0.02);
}

TEST(TwoViewStart, IsNothingWithoutSharedPoints) {
  Bundle bundle = wrong_bundle(motions[0], 2, 0, 0);
  std::erase_if(bundle.observations, [](const BundleObservation& seen) { return seen.view == 2; });
  EXPECT_FALSE(two_view_start(bundle, camera));
}

TEST(TwoViewStart, IsNothingWhereAPointIsKnown) {
  Bundle bundle = wrong_bundle(motions[0], 2, 0, 0);
  bundle.points[0].kind = BundlePoint::Kind::fixed;
  EXPECT_FALSE(two_view_start(bundle, camera));
}

/// A point that began in the second view has its ray in the axes of where that view is now.
TEST(TwoViewStart, PutsPointsOfLaterViewsOnTheirRays) {
  Bundle bundle = wrong_bundle(motions[2], 2, 0, 0);
  BundlePoint& point = bundle.points[5];
  point.host = 1;
  point.value << 9, 9, 9;
  std::erase_if(bundle.observations,
                [](const BundleObservation& seen) { return seen.point == 5 && seen.view == 0; });
  const auto start = two_view_start(bundle, camera);
  ASSERT_TRUE(start);
  const auto ray = camera.unproject(pixel_of(moved(motions[2], 0.5), scattered_points(60)[5]));
  EXPECT_LT((start->points[5].value - Eigen::Vector3d(ray->x(), ray->y(), 0.5)).norm(), 1e-9);
  EXPECT_EQ(start->points[5].initial_axes, start->views[1].world_from_camera);
}

/// Whatever views and depths were before. Of the two minima the better one is the true one.
TEST(FlatStart, LeadsAdjustmentToTheMinimumAfterASmallMotion) {
  const std::vector<Motion> small = {{"sideways", {0, 0.06, 0}, {0, 0, 0}},
                                     {"up with a turn", {0, 0.01, 0.06}, {0.02, 0.02, -0.01}}};
  for (const Motion& motion : small) {
    Bundle wrong = wrong_bundle(motion, 4, 0.05, 0);
    for (std::size_t k = 1; k < wrong.views.size(); ++k)
      wrong.views[k].position += Eigen::Vector3d(0.4, -0.3, 0.3) * static_cast<double>(k);
    for (std::size_t i = 0; i < wrong.points.size(); ++i) wrong.points[i].value[2] *= i % 2 == 0 ? 3 : 0.2;
    Bundle flat = flat_start(wrong, camera);
    for (const BundleView& view : flat.views) EXPECT_EQ(view.position, flat.views[0].position);
    for (const BundlePoint& point : flat.points) EXPECT_EQ(point.value[2], 0.5);
    BundleEquations equations;
    const double cost = adjust(flat, camera, {.max_iterations = 20}, equations).last_cost;
    Bundle reversed = reversed_start(flat, camera);
    const double other_cost = adjust(reversed, camera, {.max_iterations = 20}, equations).last_cost;
    expect_last_view(cost < other_cost ? flat : reversed, motion, 0.1, 0.01);
  }
}

TEST(FlatStart, LeavesFixedViewsAndKnownPoints) {
  Bundle bundle = wrong_bundle(motions[0], 2, 0, 0);
  bundle.views[1].fixed = true;
  bundle.views[1].position = {1, 2, 3};
  bundle.points[4].kind = BundlePoint::Kind::fixed;
  bundle.points[4].value = {4, 5, 6};
  const Bundle flat = flat_start(bundle, camera);
  EXPECT_EQ(flat.views[1].position, bundle.views[1].position);
  EXPECT_EQ(flat.points[4].value, bundle.points[4].value);
  const Bundle reversed = reversed_start(bundle, camera);
  EXPECT_EQ(reversed.views[1].position, bundle.views[1].position);
  EXPECT_EQ(reversed.points[4].value, bundle.points[4].value);
}

TEST(FlatStart, ReversesDepthsAtTheirMedian) {
  Bundle bundle = wrong_bundle(motions[0], 2, 0, 0);
  bundle.points[0].value[2] = 0.3;
  bundle.points[1].value[2] = 0.8;
  bundle.points[2].value[2] = 5;
  const Bundle reversed = reversed_start(bundle, camera);
  EXPECT_NEAR(reversed.points[0].value[2], 0.7, 1e-12);
  EXPECT_NEAR(reversed.points[1].value[2], 0.2, 1e-12);
  EXPECT_NEAR(reversed.points[2].value[2], 0.025, 1e-12) << "in front of the camera";
  EXPECT_NEAR(reversed.points[3].value[2], 0.5, 1e-12);
}

}  // namespace
}  // namespace incognita::synthetic
