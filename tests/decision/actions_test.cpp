#include "incognita/decision/actions.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "incognita/decision/decision.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/single_camera.hpp"

namespace incognita {
namespace {

TEST(Actions, AreTheSevenOfTheThesis) {
  const auto actions = seven_translations(0.3);
  ASSERT_EQ(actions.size(), 7u);
  EXPECT_EQ(actions.back().name, "stay");
  EXPECT_TRUE(actions.back().displacement_m.isZero());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& action : actions) sum += action.displacement_m;
  EXPECT_TRUE(sum.isZero()) << "every direction has its opposite";
}

TEST(Heading, IsThatOfTheLevelGaze) {
  for (const double heading : {-3.1, -1.0, 0.0, 0.4, 2.0, 3.1}) {
    const Eigen::Vector4d gaze = level_gaze(heading);
    EXPECT_NEAR(heading_of(gaze), heading, 1e-12);
    const Eigen::Matrix3d axes = rotation_matrix(gaze);
    EXPECT_NEAR(axes.col(1).z(), -1, 1e-12) << "image down is world down";
    EXPECT_NEAR(axes.determinant(), 1, 1e-12);
  }
}

TEST(Heading, AndElevationAreThoseOfTheGaze) {
  for (const double heading : {-3.1, 0.0, 0.4, 2.0})
    for (const double elevation : {-1.2, -0.3, 0.0, 0.8}) {
      const Eigen::Vector4d gaze = gaze_at(heading, elevation);
      EXPECT_NEAR(heading_of(gaze), heading, 1e-9);
      EXPECT_NEAR(elevation_of(gaze), elevation, 1e-9);
      EXPECT_NEAR(rotation_matrix(gaze)(2, 0), 0, 1e-12) << "no roll: the image rows are level";
    }
}

/// A camera at the origin, facing +x, with one uncertain and one accurate landmark ahead.
Estimate two_landmarks() {
  Estimate estimate;
  CameraState x = CameraState::Zero();
  x.segment<4>(3) = level_gaze(0);
  estimate.bodies.emplace_back().block =
      estimate.belief.add_vehicle(FreeCameraMotion::chart, x, 1e-4 * FreeCameraMotion::Jacobian::Identity());
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  for (const double y : {-0.3, 0.3}) {
    Landmark landmark;
    landmark.id = new_id(estimate);
    landmark.camera = 0;
    const Eigen::Vector3d at(2.0, y, 0);
    const Eigen::Matrix3d cov =
        Eigen::Vector3d(0.25, 1e-4, 1e-4).asDiagonal();  // uncertain along the line of sight
    landmark.block = estimate.belief.augment(PointLandmark::chart, at, {}, cov);
    estimate.landmarks.emplace(landmark.id, landmark);
  }
  return estimate;
}

SlamEstimator one_camera(const CameraSlamSettings& slam = {}) {
  return single_camera(WideAngleCamera{}, {}, slam, 10, 1);
}

TEST(Decision, MovesAcrossTheLineOfSightToGainDepth) {
  const Estimate estimate = two_landmarks();
  CameraSlamSettings steady;  // a second of unknown accelerations would mask the parallax
  steady.filter.sigma_acceleration_m_s2 = steady.filter.sigma_angular_acceleration_rad_s2 = 0.01;
  const auto decision = decide_for(one_camera(steady));
  const BodyGoal goal = decision->choose(estimate, Tick{0, 0, 0}).bodies.at(0);
  ASSERT_TRUE(goal.decided);
  const std::string chosen = decision->actions(0)[goal.chosen];
  EXPECT_TRUE(chosen == "go_left" || chosen == "go_right" || chosen == "go_up" || chosen == "go_down")
      << chosen;
  EXPECT_NEAR((goal.to - goal.from).norm(), 0.3, 1e-12);
}

TEST(Decision, DecidesOncePerPeriodAndScoresEveryFrame) {
  const Estimate estimate = two_landmarks();
  const auto decision = decide_for(one_camera());
  int decided = 0;
  for (int k = 0; k < 61; ++k) {
    const BodyGoal goal = decision->choose(estimate, Tick{k, k / 30.0, 1 / 30.0}).bodies.at(0);
    decided += goal.decided;
    ASSERT_EQ(goal.scores.size(), 7u);
    for (const double score : goal.scores) EXPECT_GT(score, 0);
  }
  EXPECT_EQ(decided, 3);
}

TEST(Decision, ExcludesGoalsOutsideTheBounds) {
  const Estimate estimate = two_landmarks();
  DecisionSettings settings;
  settings.min_bound_m = {-0.1, -0.1, -0.1};
  settings.max_bound_m = {0.1, 0.1, 0.1};
  const auto decision = decide_for(one_camera(), {settings});
  EXPECT_EQ(decision->actions(0)[decision->choose(estimate, Tick{0, 0, 0}).bodies.at(0).chosen], "stay");
}

TEST(Decision, HasNoActionWhenLost) {
  Estimate estimate = two_landmarks();
  const auto decision = decide_for(one_camera());
  ASSERT_GE(decision->choose(estimate, Tick{0, 0, 0}).bodies.at(0).chosen, 0);
  estimate.status.state = TrackingState::lost;
  EXPECT_EQ(decision->choose(estimate, Tick{0, 0, 0}).bodies.at(0).chosen, -1);
}

}  // namespace
}  // namespace incognita
