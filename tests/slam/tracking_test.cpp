// When the estimate of a camera is degraded or lost.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "incognita/slam/mapper/health.hpp"

namespace incognita {
namespace {

/// A body with this position sigma; by default lost after 10 frames with fewer than 3 matches, or beyond 0.5 m.
struct Health {
  Estimate estimate;
  EstimatorSettings settings;

  explicit Health(double sigma_m = 0.01) {
    settings.health.max_sigma_position_m = 0.5;
    Body& body = estimate.bodies.emplace_back();
    body.state_covariance = SmallMatrix::Identity(12, 12);
    body.pose_covariance = sigma_m * sigma_m * Eigen::Matrix<double, 6, 6>::Identity();
  }
  TrackingStatus after(int matched, int searched = 12) {
    estimate.last.restart();
    estimate.last.matched = matched;
    estimate.bodies[0].counts = {searched, matched, matched};
    count_doubted(estimate, settings.health);
    return assess(estimate, 0, 1, settings);
  }
};

TEST(Health, TenFramesWithFewMatchesAreLost) {
  Health health;
  EXPECT_EQ(health.after(12).state, TrackingState::tracking);
  for (int frame = 1; frame < 10; ++frame) {
    EXPECT_EQ(health.after(2).state, TrackingState::degraded) << "frame " << frame;
    EXPECT_EQ(health.estimate.body().health.frames_with_few, frame);
  }
  const TrackingStatus status = health.after(2);
  EXPECT_EQ(status.state, TrackingState::lost);
  EXPECT_NE(status.reason.find("2 of 12"), std::string::npos) << status.reason;
  EXPECT_NE(status.reason.find("10 frames"), std::string::npos) << status.reason;
}

TEST(Health, OneGoodFrameStartsTheCountAgain) {
  Health health;
  for (int frame = 0; frame < 9; ++frame) health.after(0);
  EXPECT_EQ(health.after(3).state, TrackingState::tracking);
  EXPECT_EQ(health.estimate.body().health.frames_with_few, 0);
  for (int frame = 0; frame < 9; ++frame) EXPECT_EQ(health.after(0).state, TrackingState::degraded);
  EXPECT_EQ(health.after(0).state, TrackingState::lost);
}

TEST(Health, TheLimitsAreSettings) {
  Health health;
  health.settings.health.min_matches = 5;
  health.settings.health.max_ticks = 2;
  EXPECT_EQ(health.after(5).state, TrackingState::tracking);
  EXPECT_EQ(health.after(4).state, TrackingState::degraded);
  EXPECT_EQ(health.after(4).state, TrackingState::lost);
}

TEST(Health, AnUncertainPositionIsLostWhateverMatches) {
  EXPECT_EQ(Health(0.5 - 1e-9).after(12).state, TrackingState::tracking);
  const TrackingStatus beyond = Health(0.501).after(12);
  EXPECT_EQ(beyond.state, TrackingState::lost);
  EXPECT_NE(beyond.reason.find("limit 0.5 m"), std::string::npos) << beyond.reason;
  EXPECT_EQ(Health(std::numeric_limits<double>::quiet_NaN()).after(12).state, TrackingState::lost);
}

TEST(Health, ImprobablyLargeInnovationsAreDegradedAndThenLost) {
  Health health;
  health.estimate.health.recent_rows = 200;
  health.estimate.health.recent_nis = 1000;  // 2.2 sigma rms
  const TrackingStatus doubted = health.after(12);
  EXPECT_EQ(doubted.state, TrackingState::degraded);
  EXPECT_NE(doubted.reason.find("2.24 sigma rms"), std::string::npos) << doubted.reason;
  health.estimate.health.recent_nis = 30000;  // 12 sigma rms
  for (int tick = 0; tick < 9; ++tick) EXPECT_EQ(health.after(12).state, TrackingState::degraded) << tick;
  EXPECT_EQ(health.after(12).state, TrackingState::lost);
}

TEST(SigmaPosition, IsTheLongestAxis) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Body body;
  body.pose_covariance.setIdentity();
  body.pose_covariance.topLeftCorner<3, 3>() =
      turn * Eigen::Vector3d(0.01, 0.09, 0.0004).asDiagonal() * turn.transpose();
  EXPECT_NEAR(sigma_position(body), 0.3, 1e-12);
}

}  // namespace
}  // namespace incognita
