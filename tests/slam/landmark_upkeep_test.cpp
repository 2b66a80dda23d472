// Keeping the map good (thesis C.4): landmarks that fail too often are deleted, and an inverse depth whose
// depth is known becomes a point.
#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/slam/features/map_management.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

/// Landmarks of inverse depth, all correlated with the camera and with each other through it.
Tracking with_inverse_depths(const std::vector<Eigen::Vector2d>& pixels) {
  Tracking t(origin, correlated_covariance(0.01, 6));
  const Image image = Wall(2).seen_from(origin);
  for (const Eigen::Vector2d& pixel : pixels) EXPECT_TRUE(t.initialize(image, pixel));
  return t;
}

std::vector<std::int64_t> ids(const Estimate& estimate) {
  std::vector<std::int64_t> ids;
  for (const auto& [id, landmark] : estimate.landmarks) ids.push_back(id);
  return ids;
}

void set_counts(Tracking& t, std::int64_t id, int attempts, int matches) {
  t.feature(id).attempts = attempts, t.landmark(id).detection_count = matches;
}

TEST(LandmarkDeletion, OfWhatWasMatchedInLessThanHalfOfEnoughAttempts) {
  Tracking t = with_inverse_depths({{60, 60}, {120, 60}, {180, 60}, {240, 60}, {60, 150}});
  Estimate& estimate = t.estimate;
  set_counts(t, 0, 10, 4);   // less than half
  set_counts(t, 1, 10, 5);   // half
  set_counts(t, 2, 9, 0);    // too few to judge
  set_counts(t, 3, 40, 19);  // less than half
  set_counts(t, 4, 40, 20);
  const Tracking before = t;
  t.tracked.settings.map = {.min_attempts = 10, .min_matched_share = 0.5, .memory_attempts = 0};
  delete_bad_landmarks(estimate, t.tracked);
  EXPECT_EQ(ids(estimate), (std::vector<std::int64_t>{1, 2, 4}));
  EXPECT_EQ(t.tracked.features.size(), 3u);
  EXPECT_EQ(estimate.belief.errors(), 12 + 3 * 6);
  const AnyBelief& old = before.estimate.belief;
  for (const auto& [id, landmark] : estimate.landmarks) {
    EXPECT_EQ(estimate.belief.mean(landmark.block), old.mean(landmark.block));
    EXPECT_EQ(estimate.belief.covariance(landmark.block, t.camera_block()),
              old.covariance(landmark.block, t.camera_block()));
  }
  EXPECT_EQ(estimate.belief.covariance(t.landmark(1).block, t.landmark(4).block),
            old.covariance(before.landmark(1).block, before.landmark(4).block));
  t.tracked.settings.map = {.min_attempts = 9, .min_matched_share = 0.5, .memory_attempts = 0};
  delete_bad_landmarks(estimate, t.tracked);
  EXPECT_EQ(ids(estimate), (std::vector<std::int64_t>{1, 4})) << "nine are enough here";
  t.tracked.settings.map = {.min_attempts = 9, .min_matched_share = 0.51, .memory_attempts = 0};
  delete_bad_landmarks(estimate, t.tracked);
  EXPECT_TRUE(estimate.landmarks.empty());
  EXPECT_TRUE(t.tracked.features.empty());
  EXPECT_EQ(estimate.belief.errors(), 12);
}

/// Counts one frame in which a landmark was searched for and, perhaps, matched.
void count_frame(Tracking& t, std::int64_t id, bool matched) {
  FeatureMatch match{};
  match.point.setZero();
  match.id = id;
  match.outcome = matched ? MatchOutcome::matched : MatchOutcome::not_found;
  t.tracked.matches = {match};
  count_attempts(t.estimate, t.tracked);
}

TEST(LandmarkDeletion, WithAMemoryOfWhatStoppedMatching) {
  for (const int memory : {0, 10}) {
    Tracking t = with_inverse_depths({{60, 60}, {120, 60}});
    t.tracked.settings.map.memory_attempts = memory;
    for (int frame = 0; frame < 200; ++frame)
      for (const std::int64_t id : {0, 1}) count_frame(t, id, true);
    for (int frame = 0; frame < 8; ++frame) count_frame(t, 0, false);
    delete_bad_landmarks(t.estimate, t.tracked);
    // 0.9^7 < 0.5 < 0.9^6: the seventh failure is one too many
    EXPECT_EQ(ids(t.estimate),
              memory == 0 ? (std::vector<std::int64_t>{0, 1}) : std::vector<std::int64_t>{1});
  }
}

TEST(LandmarkDeletion, SparesALandmarkThatFailsNowAndThen) {
  Tracking t = with_inverse_depths({{60, 60}});
  t.tracked.settings.map.memory_attempts = 10;
  for (int frame = 0; frame < 300; ++frame) {
    count_frame(t, 0, frame % 3 != 0);
    delete_bad_landmarks(t.estimate, t.tracked);
    ASSERT_EQ(t.estimate.landmarks.size(), 1u) << "frame " << frame;
  }
}

TEST(ExpectedMatches, AreOfLandmarksThatMatchedOfLate) {
  Tracking t = with_inverse_depths({{60, 60}, {120, 60}, {180, 60}});
  t.tracked.settings.map.memory_attempts = 10;
  for (int frame = 0; frame < 100; ++frame) count_frame(t, 0, true), count_frame(t, 1, false);
  t.tracked.matches.clear();
  for (const std::int64_t id : {0, 1, 2}) t.tracked.matches.emplace_back().id = id;
  EXPECT_NEAR(match_probability(t.feature(0)), 1, 1e-12);
  EXPECT_NEAR(match_probability(t.feature(1)), 1.0 / 11, 1e-4) << "one success in 10 + 1 searches";
  EXPECT_EQ(match_probability(t.feature(2)), 1) << "not searched yet";
  EXPECT_NEAR(expected_matches(t.tracked), 2 + 1.0 / 11, 1e-4);
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
  Tracking t = with_inverse_depths({{60, 60}, {120, 60}});
  set_inverse_depth(t.estimate, t.landmark(0), -0.01, 0.1);
  set_inverse_depth(t.estimate, t.landmark(1), 0.01, 0.1);
  delete_bad_landmarks(t.estimate, t.tracked);
  EXPECT_EQ(ids(t.estimate), std::vector<std::int64_t>{1});
  EXPECT_EQ(t.estimate.belief.errors(), 18);
}

TEST(LandmarkDeletion, NeverOfAnchorsNorOfLines) {
  CameraSlamSettings lines = few_features();
  lines.initialization.method = InitializationSettings::Method::depth_line;
  Tracking t(origin, correlated_covariance(0.01, 6), lines);
  const Image image = Wall(2).seen_from(origin);
  ASSERT_TRUE(t.initialize(image, {60, 60}));
  add_anchor(Wall(2).point_at(origin, {100, 100}),
             cut_view(ImagePyramid(image), {100, 100}, origin, camera, lines).value(), t.estimate, t.tracked);
  for (const std::int64_t id : ids(t.estimate)) set_counts(t, id, 1000, 0);
  delete_bad_landmarks(t.estimate, t.tracked);
  EXPECT_EQ(ids(t.estimate), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(t.estimate.belief.errors(), 17);
}

/// Civera's index: 4 sigma_d / d_camera |cos parallax|, with sigma_d that of the depth along the first ray.
double linearity_index(const Estimate& estimate, const Landmark& landmark) {
  const Eigen::VectorXd y = estimate.belief.mean(landmark.block);
  const double sigma = std::sqrt(estimate.belief.covariance(landmark.block)(5, 5));
  const Eigen::Vector3d ray =
      rotation_matrix<double>(landmark.form.initial_axes) * Eigen::Vector3d(y[3], y[4], 1);
  const Eigen::Vector3d from_first = ray / y[5];
  const Eigen::Vector3d from_now = y.head<3>() + from_first - free_camera::position(estimate.camera_state());
  const double sigma_m = ray.norm() * sigma / (y[5] * y[5]);
  return 4 * sigma_m / from_now.norm() * std::abs(from_first.normalized().dot(from_now.normalized()));
}

void simplify(Tracking& t, double max_linearity) {
  t.tracked.settings.initialization.max_linearity = max_linearity;
  simplify_landmarks(t.estimate, t.tracked);
}

TEST(LandmarkConversion, HappensAsSoonAsTheLinearityIndexAllows) {
  for (const CameraState& from : {camera_at({0.2, 0.3, 0}), camera_at({-1, 0.5, 0.2}, 0.3)}) {
    Tracking t = with_inverse_depths({{60, 60}, {250, 170}});
    set_inverse_depth(t.estimate, t.landmark(0), 0.5, 0.011);
    set_inverse_depth(t.estimate, t.landmark(1), 0.5, 0.013);
    t.move_to(from);
    const double first = linearity_index(t.estimate, t.landmark(0));
    const double second = linearity_index(t.estimate, t.landmark(1));
    ASSERT_GT(std::abs(first - second), 1e-4);
    simplify(t, std::min(first, second) - 1e-6);
    for (const auto& [id, l] : t.estimate.landmarks) EXPECT_EQ(l.form.kind, Kind::inverse_depth);
    simplify(t, std::min(first, second) + 1e-6);
    const std::int64_t nearer = first < second ? 0 : 1;
    EXPECT_EQ(t.landmark(nearer).form.kind, Kind::point);
    EXPECT_EQ(t.landmark(1 - nearer).form.kind, Kind::inverse_depth);
    simplify(t, std::max(first, second) + 1e-6);
    for (const auto& [id, l] : t.estimate.landmarks) EXPECT_EQ(l.form.kind, Kind::point);
  }
}

TEST(LandmarkConversion, TransformsMeanCovarianceAndCrossCovariances) {
  Tracking t = with_inverse_depths({{60, 60}, {250, 170}});
  set_inverse_depth(t.estimate, t.landmark(0), 0.45, 0.002);
  const Tracking copy = t;
  const AnyBelief& before = copy.estimate.belief;
  const Landmark& old = copy.landmark(0);
  simplify_landmarks(t.estimate, t.tracked);
  ASSERT_EQ(t.landmark(0).form.kind, Kind::point);
  ASSERT_EQ(t.landmark(1).form.kind, Kind::inverse_depth);
  const Eigen::MatrixXd J = numeric_jacobian(6, 1e-6, [&](const Eigen::VectorXd& e) {
    const Eigen::VectorXd y = Eigen::VectorXd(before.mean(old.block)) + e;
    return Eigen::VectorXd(y.head<3>() + rotation_matrix<double>(old.form.initial_axes) *
                                             Eigen::Vector3d(y[3], y[4], 1) / y[5]);
  });
  const BlockId block = t.landmark(0).block, other = t.landmark(1).block;
  const Eigen::Vector3d mean = t.estimate.belief.mean(block);
  EXPECT_TRUE(pixel_of(origin, mean).isApprox(Eigen::Vector2d(60, 60), 0.05)) << "it stays on its ray";
  EXPECT_NEAR(mean.x(), 1 / 0.45, 0.02);
  const auto covariance = [&](BlockId a, BlockId b) {
    return Eigen::MatrixXd(t.estimate.belief.covariance(a, b));
  };
  EXPECT_TRUE(covariance(block, block).isApprox(J * before.covariance(old.block) * J.transpose(), 1e-6));
  EXPECT_TRUE(covariance(block, t.camera_block())
                  .isApprox(J * before.covariance(old.block, copy.camera_block()), 1e-6));
  EXPECT_TRUE(
      covariance(block, other).isApprox(J * before.covariance(old.block, copy.landmark(1).block), 1e-6));
  EXPECT_EQ(covariance(other, other), Eigen::MatrixXd(before.covariance(copy.landmark(1).block)));
}

TEST(LandmarkConversion, NeverOfAnInverseDepthThatIsNotPositive) {
  Tracking t = with_inverse_depths({{60, 60}});
  set_inverse_depth(t.estimate, t.landmark(0), -0.001, 1e-5);
  simplify(t, 1e6);
  EXPECT_EQ(t.landmark(0).form.kind, Kind::inverse_depth);
  set_inverse_depth(t.estimate, t.landmark(0), 0.001, 1e-6);
  simplify(t, 1e6);
  EXPECT_EQ(t.landmark(0).form.kind, Kind::point) << "this one is";
}

}  // namespace
}  // namespace incognita
