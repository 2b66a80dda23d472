#include "incognita/slam/features/tracking.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

namespace incognita {
namespace {

const CameraSlamSettings settings;  // lost after 10 frames with fewer than 3 matches, or beyond 0.5 m
constexpr double well_known_m = 0.01;

TEST(SteeringValidator, TenFramesWithFewMatchesAreLost) {
  TrackingStatus status;
  status = assess(status, 12, 12, well_known_m, settings);
  EXPECT_EQ(status.state, TrackingState::tracking);
  for (int frame = 1; frame < 10; ++frame) {
    status = assess(status, 2, 12, well_known_m, settings);
    EXPECT_EQ(status.state, TrackingState::degraded) << "frame " << frame;
    EXPECT_EQ(status.frames_with_few, frame);
  }
  status = assess(status, 2, 12, well_known_m, settings);
  EXPECT_EQ(status.state, TrackingState::lost);
  EXPECT_NE(status.reason.find("2 of 12"), std::string::npos) << status.reason;
  EXPECT_NE(status.reason.find("10 frames"), std::string::npos) << status.reason;
}

TEST(SteeringValidator, OneGoodFrameStartsTheCountAgain) {
  TrackingStatus status;
  for (int frame = 0; frame < 9; ++frame) status = assess(status, 0, 12, well_known_m, settings);
  status = assess(status, 3, 12, well_known_m, settings);
  EXPECT_EQ(status.state, TrackingState::tracking);
  EXPECT_EQ(status.frames_with_few, 0);
  for (int frame = 0; frame < 9; ++frame) {
    status = assess(status, 0, 12, well_known_m, settings);
    EXPECT_EQ(status.state, TrackingState::degraded);
  }
  EXPECT_EQ(assess(status, 0, 12, well_known_m, settings).state, TrackingState::lost);
}

TEST(SteeringValidator, AnUncertainPositionIsLostWhateverMatches) {
  EXPECT_EQ(assess({}, 12, 12, 0.5, settings).state, TrackingState::tracking);
  const TrackingStatus beyond = assess({}, 12, 12, 0.501, settings);
  EXPECT_EQ(beyond.state, TrackingState::lost);
  EXPECT_NE(beyond.reason.find("limit 0.5 m"), std::string::npos) << beyond.reason;
  EXPECT_EQ(assess({}, 12, 12, std::numeric_limits<double>::quiet_NaN(), settings).state,
            TrackingState::lost);
}

TEST(SigmaPosition, IsTheLongestAxis) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(12, 12);
  P.topLeftCorner<3, 3>() = turn * Eigen::Vector3d(0.01, 0.09, 0.0004).asDiagonal() * turn.transpose();
  CameraState x = CameraState::Zero();
  x[3] = 1;
  Estimate estimate;
  estimate.camera = estimate.belief.add_vehicle(FreeCameraMotion::chart, x, P);
  EXPECT_NEAR(sigma_position(estimate), 0.3, 1e-12);
}

}  // namespace
}  // namespace incognita
