#include "incognita/decision/team_decision.hpp"

#include <gtest/gtest.h>

#include "incognita/models/heading.hpp"
#include "incognita/models/wide_angle_camera.hpp"

namespace incognita {
namespace {

EstimatorSettings one_camera() {
  SmallVector start = SmallVector::Zero(13);
  start.segment<4>(3) = level_gaze(0);
  EstimatorSettings team;
  team.bodies.push_back(body_with_sensor(FreeCameraMotion{}, CameraSensor{Camera(WideAngleCamera{}), {}},
                                         start, SmallVector::Constant(12, 0.01),
                                         SmallVector::Constant(6, 0.3), SmallVector::Constant(2, 1)));
  return team;
}

TEST(TeamDecision, HoldsTheGazeAndRefusesToSwingIt) {
  EXPECT_NO_THROW(TeamDecision(one_camera(), {}));
  TeamDecisionSettings settings;
  settings.decision.gaze = DecisionSettings::Gaze::swing;
  try {
    TeamDecision(one_camera(), settings);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("decision.gaze: `swing`"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace incognita
