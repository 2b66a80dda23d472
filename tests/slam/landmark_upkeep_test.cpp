// Keeping the map good (thesis C.4): landmarks that fail too often are deleted, and an inverse depth whose
// depth is known becomes a point.
#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/slam/features/map_management.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const CameraState origin = camera_at({0, 0, 0});

/// Landmarks of inverse depth, all correlated with the camera and with each other through it.
Estimate with_inverse_depths(const std::vector<Eigen::Vector2d>& pixels) {
  Estimate estimate = estimate_at(origin, correlated_covariance(0.01, 6));
  const Image image = Wall(2).seen_from(origin);
  for (const Eigen::Vector2d& pixel : pixels)
    EXPECT_TRUE(initialize_landmark(image, pixel, estimate, camera, {}));
  return estimate;
}

std::vector<std::int64_t> ids(const Estimate& estimate) {
  std::vector<std::int64_t> ids;
  for (const Landmark& landmark : estimate.catalog) ids.push_back(landmark.id);
  return ids;
}

void set_counts(Landmark& landmark, int attempts, int matches) {
  landmark.attempts = attempts, landmark.matches = matches;
}

TEST(LandmarkDeletion, OfWhatWasMatchedInLessThanHalfOfEnoughAttempts) {
  Estimate estimate = with_inverse_depths({{60, 60}, {120, 60}, {180, 60}, {240, 60}, {60, 150}});
  set_counts(estimate.catalog[0], 10, 4);   // less than half
  set_counts(estimate.catalog[1], 10, 5);   // half
  set_counts(estimate.catalog[2], 9, 0);    // too few to judge
  set_counts(estimate.catalog[3], 40, 19);  // less than half
  set_counts(estimate.catalog[4], 40, 20);
  const Estimate before = estimate;
  const MapSettings settings{.min_attempts = 10, .min_matched_share = 0.5};
  delete_bad_landmarks(estimate, settings);
  EXPECT_EQ(ids(estimate), (std::vector<std::int64_t>{1, 2, 4}));
  EXPECT_EQ(estimate.belief.errors(), 12 + 3 * 6);
  for (const Landmark& landmark : estimate.catalog) {
    EXPECT_EQ(estimate.belief.mean(landmark.block), before.belief.mean(landmark.block));
    EXPECT_EQ(estimate.belief.covariance(landmark.block, estimate.camera),
              before.belief.covariance(landmark.block, before.camera));
  }
  EXPECT_EQ(estimate.belief.covariance(estimate.catalog[0].block, estimate.catalog[2].block),
            before.belief.covariance(before.catalog[1].block, before.catalog[4].block));
  delete_bad_landmarks(estimate, {.min_attempts = 9, .min_matched_share = 0.5});
  EXPECT_EQ(ids(estimate), (std::vector<std::int64_t>{1, 4})) << "nine are enough here";
  delete_bad_landmarks(estimate, {.min_attempts = 9, .min_matched_share = 0.51});
  EXPECT_TRUE(estimate.catalog.empty());
  EXPECT_EQ(estimate.belief.errors(), 12);
}

/// Sets the inverse depth by a measurement of it that leaves nothing to doubt.
void set_inverse_depth(Estimate& estimate, const Landmark& landmark, double inverse_depth, double sigma) {
  const double mean = estimate.belief.mean(landmark.block)[5];
  const double var = estimate.belief.covariance(landmark.block)(5, 5);
  // A posterior of `sigma` around `inverse_depth`: R and residual from the scalar Kalman filter
  const double noise_var = 1 / (1 / (sigma * sigma) - 1 / var);
  LinearizedMeasurement depth;
  depth.add(landmark.block, Eigen::RowVectorXd(Eigen::RowVectorXd::Unit(6, 5)));
  depth.residual = Eigen::VectorXd::Constant(1, (inverse_depth - mean) * (var + noise_var) / var);
  depth.R = Eigen::MatrixXd::Constant(1, 1, noise_var);
  ASSERT_EQ(estimate.belief.update({&depth, 1}).outcome, UpdateReport::Outcome::updated);
}

TEST(LandmarkDeletion, OfAnInverseDepthBelowZero) {
  Estimate estimate = with_inverse_depths({{60, 60}, {120, 60}});
  set_inverse_depth(estimate, estimate.catalog[0], -0.01, 0.1);
  set_inverse_depth(estimate, estimate.catalog[1], 0.01, 0.1);
  delete_bad_landmarks(estimate, {});
  EXPECT_EQ(ids(estimate), std::vector<std::int64_t>{1});
  EXPECT_EQ(estimate.belief.errors(), 18);
}

TEST(LandmarkDeletion, NeverOfAnchorsNorOfLines) {
  Estimate estimate = estimate_at(origin, correlated_covariance(0.01, 6));
  CameraSlamSettings lines;
  lines.initialization.method = InitializationSettings::Method::depth_line;
  ASSERT_TRUE(initialize_landmark(Wall(2).seen_from(origin), {60, 60}, estimate, camera, lines));
  Landmark anchor;
  anchor.id = estimate.next_id++;
  anchor.kind = Landmark::Kind::anchor;
  estimate.catalog.push_back(anchor);
  for (Landmark& landmark : estimate.catalog) set_counts(landmark, 1000, 0);
  delete_bad_landmarks(estimate, {});
  EXPECT_EQ(ids(estimate), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(estimate.belief.errors(), 17);
}

/// Civera's index: 4 sigma_d / d_camera |cos parallax|, with sigma_d that of the depth along the first ray.
double linearity_index(const Estimate& estimate, const Landmark& landmark) {
  const Eigen::VectorXd y = estimate.belief.mean(landmark.block);
  const double sigma = std::sqrt(estimate.belief.covariance(landmark.block)(5, 5));
  const Eigen::Vector3d ray = rotation_matrix<double>(landmark.initial_axes.world_from_initial_camera) *
                              Eigen::Vector3d(y[3], y[4], 1);
  const Eigen::Vector3d from_first = ray / y[5];
  const Eigen::Vector3d from_now = y.head<3>() + from_first - free_camera::position(estimate.camera_state());
  const double sigma_m = ray.norm() * sigma / (y[5] * y[5]);
  return 4 * sigma_m / from_now.norm() * std::abs(from_first.normalized().dot(from_now.normalized()));
}

TEST(LandmarkConversion, HappensAsSoonAsTheLinearityIndexAllows) {
  for (const CameraState& from : {camera_at({0.2, 0.3, 0}), camera_at({-1, 0.5, 0.2}, 0.3)}) {
    Estimate estimate = with_inverse_depths({{60, 60}, {250, 170}});
    set_inverse_depth(estimate, estimate.catalog[0], 0.5, 0.011);
    set_inverse_depth(estimate, estimate.catalog[1], 0.5, 0.013);
    move_camera(estimate, from);
    const double first = linearity_index(estimate, estimate.catalog[0]);
    const double second = linearity_index(estimate, estimate.catalog[1]);
    ASSERT_GT(std::abs(first - second), 1e-4);
    InitializationSettings settings;
    settings.max_linearity = std::min(first, second) - 1e-6;
    simplify_landmarks(estimate, settings);
    for (const Landmark& l : estimate.catalog) EXPECT_EQ(l.kind, Landmark::Kind::inverse_depth);
    settings.max_linearity = std::min(first, second) + 1e-6;
    simplify_landmarks(estimate, settings);
    const std::size_t nearer = first < second ? 0 : 1;
    EXPECT_EQ(estimate.catalog[nearer].kind, Landmark::Kind::point);
    EXPECT_EQ(estimate.catalog[1 - nearer].kind, Landmark::Kind::inverse_depth);
    settings.max_linearity = std::max(first, second) + 1e-6;
    simplify_landmarks(estimate, settings);
    for (const Landmark& l : estimate.catalog) EXPECT_EQ(l.kind, Landmark::Kind::point);
  }
}

TEST(LandmarkConversion, TransformsMeanCovarianceAndCrossCovariances) {
  Estimate estimate = with_inverse_depths({{60, 60}, {250, 170}});
  set_inverse_depth(estimate, estimate.catalog[0], 0.45, 0.002);
  const Estimate before = estimate;
  const Landmark& old = before.catalog[0];
  simplify_landmarks(estimate, {});
  ASSERT_EQ(estimate.catalog[0].kind, Landmark::Kind::point);
  ASSERT_EQ(estimate.catalog[1].kind, Landmark::Kind::inverse_depth);
  EXPECT_EQ(estimate.catalog[0].id, old.id);
  const Eigen::MatrixXd J = numeric_jacobian(6, 1e-6, [&](const Eigen::VectorXd& e) {
    const Eigen::VectorXd y = Eigen::VectorXd(before.belief.mean(old.block)) + e;
    return Eigen::VectorXd(y.head<3>() + rotation_matrix<double>(old.initial_axes.world_from_initial_camera) *
                                             Eigen::Vector3d(y[3], y[4], 1) / y[5]);
  });
  const BlockId block = estimate.catalog[0].block, other = estimate.catalog[1].block;
  const Eigen::Vector3d mean = estimate.belief.mean(block);
  EXPECT_TRUE(pixel_of(origin, mean).isApprox(Eigen::Vector2d(60, 60), 0.05)) << "it stays on its ray";
  EXPECT_NEAR(mean.x(), 1 / 0.45, 0.02);
  const auto covariance = [&](BlockId a, BlockId b) {
    return Eigen::MatrixXd(estimate.belief.covariance(a, b));
  };
  EXPECT_TRUE(
      covariance(block, block).isApprox(J * before.belief.covariance(old.block) * J.transpose(), 1e-6));
  EXPECT_TRUE(covariance(block, estimate.camera)
                  .isApprox(J * before.belief.covariance(old.block, before.camera), 1e-6));
  EXPECT_TRUE(covariance(block, other)
                  .isApprox(J * before.belief.covariance(old.block, before.catalog[1].block), 1e-6));
  EXPECT_EQ(covariance(other, other), Eigen::MatrixXd(before.belief.covariance(before.catalog[1].block)));
}

TEST(LandmarkConversion, NeverOfAnInverseDepthThatIsNotPositive) {
  Estimate estimate = with_inverse_depths({{60, 60}});
  set_inverse_depth(estimate, estimate.catalog[0], -0.001, 1e-5);
  InitializationSettings settings;
  settings.max_linearity = 1e6;
  simplify_landmarks(estimate, settings);
  EXPECT_EQ(estimate.catalog[0].kind, Landmark::Kind::inverse_depth);
  set_inverse_depth(estimate, estimate.catalog[0], 0.001, 1e-6);
  simplify_landmarks(estimate, settings);
  EXPECT_EQ(estimate.catalog[0].kind, Landmark::Kind::point) << "this one is";
}

}  // namespace
}  // namespace incognita
