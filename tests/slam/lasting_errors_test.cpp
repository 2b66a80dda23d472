// Errors of matches that last are states: against the dense solution, and lent to the landmarks that are matched.
#include "incognita/slam/features/lasting_errors.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "incognita/slam/features/feature.hpp"

namespace incognita {
namespace {

FilterSettings lasting(double sigma_px, double time_s) {
  FilterSettings settings;
  settings.sigma_lasting_px = sigma_px;
  settings.lasting_time_s = time_s;
  return settings;
}

/// A belief of one unknown position in the image, px.
struct LastingErrorsScene {
  Estimate estimate;
  BlockId position;

  LastingErrorsScene() {
    position = estimate.belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(),
                                           100 * Eigen::Matrix2d::Identity());
    estimate.bodies.emplace_back().block = position;
  }
};

FeatureMatch matched(std::int64_t id) {
  FeatureMatch match{};
  match.id = id;
  match.outcome = MatchOutcome::matched;
  return match;
}

/// The measurements of a position over some frames have white noise and an error that lasts. The variance of the filter is that
/// of the best linear estimate from all of them at once, with the whole covariance matrix of their errors.
TEST(LastingErrors, TheFilterKnowsAsMuchAsAllMeasurementsTogether) {
  constexpr int frames = 40;
  constexpr double white_px = 0.05, lasting_px = 0.2, time_s = 0.7, dt = 1.0 / 30;
  LastingErrorsScene scene;
  const FilterSettings settings = lasting(lasting_px, time_s);
  LastingErrors errors;
  errors.start(scene.estimate, settings, 1);
  const std::vector<FeatureMatch> matches{matched(7)};
  for (int k = 0; k < frames; ++k) {
    errors.predict(scene.estimate, settings, dt);
    errors.lend(scene.estimate, settings, matches);
    LinearizedMeasurement measurement;
    measurement.add(scene.position, Eigen::Matrix2d::Identity());
    measurement.add(errors.of(7).value(), Eigen::Matrix2d::Identity());
    measurement.residual = Eigen::Vector2d::Zero();
    measurement.R = white_px * white_px * Eigen::Matrix2d::Identity();
    ASSERT_EQ(scene.estimate.belief.update({&measurement, 1}).outcome, UpdateReport::Outcome::updated);
  }
  Eigen::MatrixXd errors_cov(frames, frames);
  for (int i = 0; i < frames; ++i)
    for (int j = 0; j < frames; ++j)
      errors_cov(i, j) = lasting_px * lasting_px * std::exp(-std::abs(i - j) * dt / time_s) +
                         (i == j ? white_px * white_px : 0);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(frames);
  const double expected = 1 / (1 / 100. + ones.dot(errors_cov.inverse() * ones));
  const BlockMatrix P = scene.estimate.belief.covariance(scene.position);
  EXPECT_NEAR(P(0, 0) / expected, 1, 1e-9);
  EXPECT_NEAR(P(0, 1), 0, 1e-12);
  // White noise of the same size would be known to be small after 40 frames
  EXPECT_GT(P(0, 0), 10 * (white_px * white_px + lasting_px * lasting_px) / frames);
}

TEST(LastingErrors, OfAPatchOfUnknownPlaneIsLarger) {
  LastingErrorsScene scene;
  const FilterSettings settings = lasting(0.1, 5);
  LastingErrors errors;
  errors.start(scene.estimate, settings, 1);
  FeatureMatch match = matched(1);
  match.plane_cov << 0.3, 0.1, 0.1, 0.2;
  const Eigen::Matrix2d expected = match.plane_cov + 0.01 * Eigen::Matrix2d::Identity();
  errors.lend(scene.estimate, settings, {&match, 1});
  EXPECT_LT((scene.estimate.belief.covariance(*errors.of(1)) - expected).norm(), 1e-12);
  errors.predict(scene.estimate, settings, 0.3);
  EXPECT_LT((scene.estimate.belief.covariance(*errors.of(1)) - expected).norm(), 1e-12) << "it is stationary";
  // Once the plane is known, it returns to that of the settings
  match.plane_cov.setZero();
  errors.lend(scene.estimate, settings, {&match, 1});
  errors.predict(scene.estimate, settings, 100);
  EXPECT_LT((scene.estimate.belief.covariance(*errors.of(1)) - 0.01 * Eigen::Matrix2d::Identity()).norm(),
            1e-12);
}

TEST(LastingErrors, AreLentToTheLandmarksThatAreMatched) {
  LastingErrorsScene scene;
  const FilterSettings settings = lasting(0.1, 5);
  LastingErrors errors;
  errors.start(scene.estimate, settings, 1);  // two blocks
  ASSERT_EQ(scene.estimate.lasting_errors.size(), 2u);
  const auto match = [&](std::vector<std::int64_t> ids) {
    std::vector<FeatureMatch> matches;
    for (const std::int64_t id : ids) matches.push_back(matched(id));
    errors.lend(scene.estimate, settings, matches);
  };
  match({1});
  match({2});
  const BlockId first = errors.of(1).value(), second = errors.of(2).value();
  EXPECT_NE(first, second);
  match({1});
  EXPECT_EQ(errors.of(1), first) << "it keeps its block";
  match({3});
  EXPECT_EQ(errors.of(3), second) << "that of the landmark that was not matched for longest";
  EXPECT_FALSE(errors.of(2));
  match({4, 5, 6});
  EXPECT_TRUE(errors.of(4));
  EXPECT_TRUE(errors.of(5));
  EXPECT_FALSE(errors.of(6)) << "more matches than blocks";
  FeatureMatch outlier = matched(8);
  outlier.outcome = MatchOutcome::outlier;
  errors.lend(scene.estimate, settings, {&outlier, 1});
  EXPECT_FALSE(errors.of(8));
}

TEST(LastingErrors, OfANewViewAreIndependent) {
  LastingErrorsScene scene;
  const FilterSettings settings = lasting(0.1, 5);
  LastingErrors errors;
  errors.start(scene.estimate, settings, 1);
  const FeatureMatch match = matched(1);
  errors.lend(scene.estimate, settings, {&match, 1});
  LinearizedMeasurement measurement;
  measurement.add(scene.position, Eigen::Matrix2d::Identity());
  measurement.add(*errors.of(1), Eigen::Matrix2d::Identity());
  measurement.residual = Eigen::Vector2d(0.5, 0);
  measurement.R = 1e-4 * Eigen::Matrix2d::Identity();
  scene.estimate.belief.update({&measurement, 1});
  EXPECT_LT(scene.estimate.belief.covariance(scene.position, *errors.of(1))(0, 0), -1e-3);
  errors.take_back();
  EXPECT_FALSE(errors.of(1));
  errors.lend(scene.estimate, settings, {&match, 1});
  EXPECT_TRUE(scene.estimate.belief.covariance(scene.position, *errors.of(1)).isZero(0));
  EXPECT_TRUE(scene.estimate.belief.mean(*errors.of(1)).isZero(0));
}

TEST(LastingErrors, WithoutASigmaThereAreNone) {
  LastingErrorsScene scene;
  LastingErrors errors;
  errors.start(scene.estimate, lasting(0, 5), 10);
  EXPECT_TRUE(scene.estimate.lasting_errors.empty());
  const FeatureMatch match = matched(1);
  errors.lend(scene.estimate, lasting(0, 5), {&match, 1});
  EXPECT_FALSE(errors.of(1));
}

}  // namespace
}  // namespace incognita
