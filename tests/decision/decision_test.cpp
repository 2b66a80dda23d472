#include "incognita/decision/decision.hpp"

#include <gtest/gtest.h>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {
namespace {

/// Free cameras side by side, looking along x, and a landmark ahead of each.
struct Cameras {
  EstimatorSettings settings;
  Estimate estimate;

  explicit Cameras(int count) {
    for (int i = 0; i < count; ++i) {
      SmallVector start = SmallVector::Zero(13);
      start[1] = 30.0 * i;
      start.segment<4>(3) = level_gaze(0);
      settings.bodies.push_back(body_with_sensor(
          FreeCameraMotion{}, CameraSensor{Camera(WideAngleCamera{}), {}}, start,
          SmallVector::Constant(12, 0.01), SmallVector::Constant(6, 0.01), SmallVector::Constant(2, 1)));
      Body& body = estimate.bodies.emplace_back();
      body.block = estimate.belief.add_vehicle(FreeCameraMotion::chart, start,
                                               1e-4 * FreeCameraMotion::Jacobian::Identity());
    }
    for (int i = 0; i < count; ++i) {
      Landmark landmark;
      landmark.id = new_id(estimate);
      landmark.first = Eigen::Vector3d(2, 30.0 * i, 0);
      landmark.block = estimate.belief.augment(
          PointLandmark::chart, Eigen::Vector3d(2, 30.0 * i, 0), {},
          Eigen::Matrix3d(Eigen::Vector3d(0.25, i == 0 ? 1e-2 : 1e-4, 1e-4).asDiagonal()));
      estimate.landmarks.emplace(landmark.id, landmark);
    }
    estimate.started = true;
    estimate.status.state = TrackingState::tracking;
  }
};

/// Two cameras far apart, of which the second has a better known landmark: each decides as if it were alone.
TEST(Decision, ChoosesForEachBodyWithItsOwnScores) {
  const Cameras c(2);
  const Goal goal = decide_for(SlamEstimator(c.settings))->choose(c.estimate, Tick{0, 0, 0});
  ASSERT_EQ(goal.bodies.size(), 2u);
  const Cameras alone(1);
  const BodyGoal first =
      decide_for(SlamEstimator(alone.settings))->choose(alone.estimate, Tick{0, 0, 0}).bodies.at(0);
  ASSERT_EQ(goal.bodies[0].scores.size(), 7u);
  for (std::size_t a = 0; a < 7; ++a) {
    EXPECT_NEAR(goal.bodies[0].scores[a], first.scores[a], 1e-9) << a;
    EXPECT_LT(goal.bodies[1].scores[a], goal.bodies[0].scores[a]) << a << ": less to gain";
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(goal.bodies[i].decided);
    EXPECT_NEAR(goal.bodies[i].from.y(), 30.0 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR((goal.bodies[i].to - goal.bodies[i].from).norm(), 0.3, 1e-12) << "across the line of sight";
  }
}

TEST(Decision, LeavesTheGazeFreeWhereItSwings) {
  const Cameras c(1);
  ActiveSettings settings;
  settings.decision.gaze = DecisionSettings::Gaze::swing;
  EXPECT_FALSE(decide_for(SlamEstimator(c.settings), settings)
                   ->choose(c.estimate, Tick{0, 0, 0})
                   .bodies.at(0)
                   .heading_rad);
  settings.decision.gaze = DecisionSettings::Gaze::hold;
  EXPECT_EQ(decide_for(SlamEstimator(c.settings), settings)
                ->choose(c.estimate, Tick{0, 0, 0})
                .bodies.at(0)
                .heading_rad,
            0);
}

TEST(Decision, HasNoActionBeforeTheStartAndAfterTheEstimateWasLost) {
  Cameras c(1);
  const auto decision = decide_for(SlamEstimator(c.settings));
  EXPECT_EQ(decision->choose(Estimate{}, Tick{0, 0, 0}).bodies.at(0).chosen, -1);
  const BodyGoal before = decision->choose(c.estimate, Tick{1, 0.1, 0.1}).bodies.at(0);
  EXPECT_GE(before.chosen, 0);
  EXPECT_GT(before.scores[0], 0);
  c.estimate.status.state = TrackingState::lost;
  const BodyGoal lost = decision->choose(c.estimate, Tick{2, 0.2, 0.1}).bodies.at(0);
  EXPECT_EQ(lost.chosen, -1);
  EXPECT_FALSE(lost.decided);
  EXPECT_EQ(lost.scores, std::vector<double>(7, 0));
  c.estimate.status.state = TrackingState::tracking;
  EXPECT_TRUE(decision->choose(c.estimate, Tick{3, 0.3, 0.1}).bodies.at(0).decided) << "anew";
}

/// A robot whose scanner looks ahead, and a landmark behind it.
double gain_of_staying(std::vector<PointSensor> sensors) {
  EstimatorSettings settings;
  settings.bodies.push_back(body_with_sensor(DifferentialDrive{}, RangeBearingSensor{},
                                             Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(0.1),
                                             Eigen::Vector2d::Constant(0.05), Eigen::Vector2d(0.1, 0.02)));
  settings.bodies[0].sensors = std::move(sensors);
  Estimate e;
  Body& body = e.bodies.emplace_back();
  body.block = e.belief.add_vehicle(chart_of(settings.bodies[0].motion), SmallVector(Eigen::Vector3d::Zero()),
                                    0.01 * Eigen::Matrix3d::Identity());
  Landmark landmark;
  landmark.id = new_id(e);
  landmark.first = Eigen::Vector2d(-3, 0);
  landmark.block =
      e.belief.augment(Chart::line(2), Eigen::Vector2d(-3, 0), {}, 0.1 * Eigen::Matrix2d::Identity());
  e.landmarks.emplace(landmark.id, landmark);
  e.started = true;
  e.status.state = TrackingState::tracking;
  ActiveSettings active;
  active.decision.min_bound_m.setConstant(-9), active.decision.max_bound_m.setConstant(9);
  const auto decision = decide_for(SlamEstimator(settings), active);
  const auto& names = decision->actions(0);
  const auto stay = static_cast<std::size_t>(std::ranges::find(names, "stay") - names.begin());
  return decision->choose(e, Tick{0, 0, 0}).bodies.at(0).scores.at(stay);
}

TEST(Decision, CountsTheMeasurementsOfAllSensorsOfABody) {
  PointSensor ahead{RangeBearingSensor{}, Eigen::Vector2d(0.1, 0.02)}, around = ahead;
  ahead.limits.field_of_view_rad = 1;
  const double none = gain_of_staying({ahead}), behind = gain_of_staying({around});
  EXPECT_GT(behind, none + 1);
  EXPECT_NEAR(gain_of_staying({ahead, around}), behind, 1e-12);
  EXPECT_GT(gain_of_staying({around, around}), behind + 0.1) << "two scanners measure more than one";
}

TEST(Decision, RefusesAMapInTheVehicleFrameAndNoBodies) {
  Cameras c(1);
  c.settings.filter.map_frame = MapFrame::vehicle;
  EXPECT_THROW(decide_for(SlamEstimator(c.settings)), std::invalid_argument);
  EXPECT_THROW(decide_for(SlamEstimator(EstimatorSettings{})), std::invalid_argument);
  Cameras blind(1);
  blind.settings.bodies[0].sensors.clear();
  EXPECT_THROW(decide_for(SlamEstimator(blind.settings)), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
