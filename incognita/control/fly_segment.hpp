// Flight of a free camera along a segment.
#pragma once

#include "incognita/control/settings.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

/// (5.29), track_reference.hpp, along a minimum-jerk segment from rest to rest, with a level gaze.
FreeCameraMotion::Input<double> fly_segment(const CameraState& state, const Segment& segment,
                                            const Heading& gaze, double t, const ControlSettings& settings);

}  // namespace incognita
