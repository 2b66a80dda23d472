// How the single-camera estimator starts: from a known target, or where it is.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <stdexcept>
#include <string>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/mapper/health.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita {
namespace {

using namespace synthetic;

SlamEstimator from_target(double max_search_s = 10) {
  CameraSlamSettings settings = few_features();
  settings.filter.sigma_pixel_px = 0.4;
  return single_camera(camera, sheet_target(), settings, max_search_s, 1);
}

TEST(CameraStart, FromATargetIsAtTheTruePose) {
  const CameraState truths[] = {camera_at({0, 0, 0}), camera_at({0.3, 0.25, 0.1}, -0.15),
                                camera_at({0, -0.3, -0.1}, 0.15, {0.05, 0, 0.05})};
  for (const CameraState& truth : truths) {
    SlamEstimator estimator = from_target();
    Estimate estimate;
    estimator.update(estimate, {}, seeing(wall_with_sheet().shared_view(truth)), tick(0));
    ASSERT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
    EXPECT_TRUE(estimate.started);
    EXPECT_NE(estimate.status.reason.find("sheet"), std::string::npos) << estimate.status.reason;

    const auto error = camera_error(truth, estimate.camera_state());
    // A flat target, nearly straight on, hardly distinguishes a step aside from a rotation about it
    EXPECT_LT(error.head<3>().norm(), 0.06) << error.transpose();
    EXPECT_LT(error.segment<3>(3).norm(), 0.04) << error.transpose();
    EXPECT_LT(sigma_position(estimate.body()), 0.1);
    const Eigen::MatrixXd P = estimate.belief.covariance(estimate.body().block);
    const Eigen::MatrixXd pose = P.topLeftCorner(6, 6);
    EXPECT_LT(error.head<6>().dot(pose.inverse() * error.head<6>()), 16.8) << "99 % of chi-square with 6";
    EXPECT_TRUE(estimate.camera_state().tail<6>().isZero(0)) << "at rest";
    EXPECT_NEAR(P(6, 6), 0.04, 1e-12) << "sigma_start_velocity_m_s";
    EXPECT_NEAR(P(11, 11), 0.04, 1e-12) << "sigma_start_angular_rate_rad_s";
  }
}

TEST(CameraStart, FromATargetHasItsCornersAsAnchors) {
  SlamEstimator estimator = from_target();
  Estimate estimate;
  estimator.update(estimate, {}, seeing(wall_with_sheet().shared_view(camera_at({0, 0, 0}))), tick(0));
  ASSERT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
  std::vector<Landmark> anchors;
  for (const auto& [id, landmark] : estimate.landmarks)
    if (landmark.fixed) anchors.push_back(landmark);
  const Target target = sheet_target();
  ASSERT_EQ(anchors.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(Eigen::Vector3d(anchors[i].position), target.corners[i].position);
    const Feature& feature = estimator.cameras()[0].camera().features.at(anchors[i].id);
    EXPECT_TRUE(feature.view.plane.known()) << "its plane is the target's";
    EXPECT_EQ(feature.view.plane.normal(), target.normal);
  }
  const int mapped = estimate.mapped_count();
  EXPECT_EQ(estimate.belief.errors(), 12 + 6 * mapped) << "anchors are no states";
  EXPECT_GE(mapped, 6) << "and the first map is there at once, up to 12 in view";
  EXPECT_LE(mapped + 4, 12);

  // Seen again from nearby they hold the camera
  for (int k = 1; k <= 5; ++k)
    estimator.update(estimate, {}, seeing(wall_with_sheet().shared_view(camera_at({0, 0.01 * k, 0}))),
                     tick(k));
  EXPECT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
  EXPECT_LT(camera_error(camera_at({0, 0.05, 0}), estimate.camera_state()).head<3>().norm(), 0.03);
}

TEST(CameraStart, SearchesUntilTheTargetIsSeen) {
  for (const auto& [frame, t] : {std::pair<int, double>{0, 0}, {17, 1.3e9}, {3, -5}}) {
    SlamEstimator estimator = from_target(10);
    Estimate estimate;
    const CameraState truth = camera_at({0, 0, 0});
    estimator.update(estimate, {}, {}, tick(0, frame, t));
    EXPECT_EQ(estimate.status.state, TrackingState::starting);
    EXPECT_FALSE(estimate.status.reason.empty());
    for (int k = 1; k < 4; ++k) {
      estimator.update(estimate, {}, seeing(Wall(1.4, 5).shared_view(truth)), tick(k, frame, t));
      EXPECT_EQ(estimate.status.state, TrackingState::starting);
      EXPECT_NE(estimate.status.reason.find("sheet"), std::string::npos) << estimate.status.reason;
      EXPECT_FALSE(estimate.started);
      EXPECT_TRUE(estimate.landmarks.empty());
    }
    estimator.update(estimate, {}, seeing(wall_with_sheet().shared_view(truth)), tick(4, frame, t));
    EXPECT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
    EXPECT_LT(camera_error(truth, estimate.camera_state()).head<3>().norm(), 0.03);
  }
}

TEST(CameraStart, GivesUpAfterTheLongestSearchAndSaysWhy) {
  SlamEstimator estimator = from_target(0.5);
  Estimate estimate;
  const auto elsewhere = Wall(1.4, 5).shared_view(camera_at({0, 0, 0}));
  for (const int k : {0, 7, 15}) {
    estimator.update(estimate, {}, seeing(elsewhere), tick(k, 0, 100));
    EXPECT_EQ(estimate.status.state, TrackingState::starting) << k;
  }
  estimator.update(estimate, {}, seeing(elsewhere), tick(16, 0, 100));
  EXPECT_EQ(estimate.status.state, TrackingState::lost);
  EXPECT_NE(estimate.status.reason.find("sheet"), std::string::npos) << estimate.status.reason;
  EXPECT_FALSE(estimate.started) << "there is no pose, not even a wrong one";
  estimator.update(estimate, {}, seeing(elsewhere), tick(17, 0, 100));
  EXPECT_EQ(estimate.status.state, TrackingState::lost) << "still";
  estimator.update(estimate, {}, seeing(wall_with_sheet().shared_view(camera_at({0, 0, 0}))),
                   tick(18, 0, 100));
  EXPECT_EQ(estimate.status.state, TrackingState::tracking) << "nothing stands against a late start";
}

TEST(CameraStart, GivesUpWithoutAnyImageToo) {
  SlamEstimator estimator = from_target(0.5);
  Estimate estimate;
  estimator.update(estimate, {}, {}, tick(0, 0, 100));
  EXPECT_EQ(estimate.status.state, TrackingState::starting);
  estimator.update(estimate, {}, {}, tick(16, 0, 100));
  EXPECT_EQ(estimate.status.state, TrackingState::lost);
  EXPECT_NE(estimate.status.reason.find("no image"), std::string::npos) << estimate.status.reason;
}

TEST(CameraStart, WithoutATargetTheFirstViewIsTheOrigin) {
  CameraSlamSettings settings = few_features();
  settings.initialization.inverse_depth_per_m = 0.4;
  settings.map.wanted_visible = 10;
  SlamEstimator estimator = single_camera(camera, std::nullopt, settings, 10, 1);
  Estimate estimate;
  estimator.update(estimate, {}, {}, tick(0, 5, 77));
  EXPECT_EQ(estimate.status.state, TrackingState::starting) << "no image yet";
  const CameraState anywhere = camera_at({0.3, 1, -2}, 0.2);
  estimator.update(estimate, {}, seeing(Wall(2).shared_view(anywhere)), tick(1, 5, 77));
  EXPECT_EQ(estimate.status.state, TrackingState::tracking);
  EXPECT_NE(estimate.status.reason.find("scale"), std::string::npos) << estimate.status.reason;
  EXPECT_TRUE(camera_error(camera_at({0, 0, 0}), estimate.camera_state()).isZero(1e-12))
      << "level, looking along +x";
  EXPECT_LT(sigma_position(estimate.body()), 1e-3) << "the origin is where it is by definition";
  EXPECT_EQ(estimate.landmarks.size(), 10u) << "the first map at once";
  for (const auto& [id, landmark] : estimate.landmarks) {
    EXPECT_EQ(landmark.form.kind, Kind::inverse_depth);
    EXPECT_EQ(estimate.belief.mean(landmark.block)[5], 0.4) << "the scale is the prior's";
    EXPECT_TRUE(Eigen::Vector3d(estimate.belief.mean(landmark.block).head<3>()).isZero(0));
  }
}

TEST(CameraStart, AnImageOfAnotherSizeIsRefused) {
  for (const bool targeted : {false, true}) {
    SlamEstimator estimator =
        single_camera(camera, targeted ? std::optional(sheet_target()) : std::nullopt, {}, 10, 1);
    Estimate estimate;
    try {
      estimator.update(estimate, {}, seeing(std::make_shared<const Image>(640, 480, 9)), tick(0));
      FAIL() << "it was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("640x480"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("320x240"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(estimate.started);
  }
}

}  // namespace
}  // namespace incognita
