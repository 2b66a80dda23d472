// The truth of one camera, for tests that move it by themselves.
#pragma once

#include "incognita/models/any_motion.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/world/truth.hpp"

namespace incognita::testing {

inline Truth camera_truth(const CameraState& state) {
  BodyTruth body;
  body.state = state;
  body.pose = pose_of(FreeCameraMotion{}, state);
  return {{body}};
}

}  // namespace incognita::testing
