// The pixel noise follows the residuals of the matches.
#include "incognita/slam/features/pixel_noise.hpp"

#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

/// What is estimated after 300 frames of 40 matches with this noise, of which a share is off by 20 px. The errors of a landmark in
/// successive frames have this correlation.
TrackedCamera after_frames(double sigma_px, double outliers, double correlation = 0) {
  RandomStream random(1, "noise");
  Tracking t(camera_at({0, 0, 1}), 1e-4 * CameraCov::Identity());
  for (int i = 0; i < 40; ++i) {
    Landmark landmark;
    landmark.id = i;
    landmark.fixed = true;
    landmark.position = Eigen::Vector3d(2, random.uniform(-0.5, 0.5), random.uniform(0.7, 1.3));
    landmark.first_view = t.tracked.view.camera.head<3>();
    t.estimate.landmarks.emplace(i, landmark);
  }
  PixelNoise noise;
  std::vector<Eigen::Vector2d> errors(40, Eigen::Vector2d::Zero());
  for (int frame = 0; frame < 300; ++frame) {
    t.tracked.matches.clear();
    for (const auto& [id, landmark] : t.estimate.landmarks) {
      FeatureMatch match{};
      match.id = id;
      match.outcome = MatchOutcome::matched;
      Eigen::Vector2d& error = errors[static_cast<std::size_t>(id)];
      const Eigen::Vector2d white(random.normal(), random.normal());
      error = correlation * error + std::sqrt(1 - correlation * correlation) * white;
      match.measured = pixel_of(t.tracked.view.camera, landmark.position) + sigma_px * error;
      if (random.uniform(0, 1) < outliers) *match.measured += Eigen::Vector2d(20, 0);
      t.tracked.matches.push_back(match);
    }
    noise.update(t.estimate, t.tracked);
  }
  return t.tracked;
}

double estimated_px(double sigma_px, double outliers) {
  return after_frames(sigma_px, outliers).sigma_pixel_px.value();
}

TEST(PixelNoise, OfWhiteErrorsDoesNotLast) { EXPECT_NEAR(after_frames(0.5, 0).lasting_factor, 1, 0.1); }

TEST(PixelNoise, LastsByTheCorrelationOfSuccessiveErrors) {
  for (const double r : {0.5, 0.8, 0.9})
    EXPECT_NEAR(after_frames(0.5, 0, r).lasting_factor / ((1 + r) / (1 - r)), 1, 0.25) << r;
}

TEST(PixelNoise, LastsAtMost39Times) { EXPECT_NEAR(after_frames(0.5, 0, 0.999).lasting_factor, 39, 1e-9); }

TEST(PixelNoise, OfOutliersIsNotPartOfWhatLasts) {
  EXPECT_NEAR(after_frames(0.5, 0.1).lasting_factor, 1, 0.15);
}

TEST(PixelNoise, IsThatOfTheMatches) {
  // These residuals are of a known camera, while a camera of 6 unknowns is assumed: 4 % too large
  EXPECT_NEAR(estimated_px(0.8, 0) / 0.8, 1.04, 0.05);
  EXPECT_NEAR(estimated_px(1.5, 0) / 1.5, 1.04, 0.05);
}

TEST(PixelNoise, GrowsLittleByOutliers) { EXPECT_LT(estimated_px(0.8, 0.1), 1.2 * 0.8); }

TEST(PixelNoise, IsNeverTooSmallForASearch) { EXPECT_EQ(estimated_px(0.01, 0), 0.25); }

TEST(PixelNoise, StaysWithFewMatches) {
  Tracking t(camera_at({0, 0, 1}), 1e-4 * CameraCov::Identity());
  PixelNoise().update(t.estimate, t.tracked);
  EXPECT_FALSE(t.tracked.sigma_pixel_px);
}

}  // namespace
}  // namespace incognita::synthetic
