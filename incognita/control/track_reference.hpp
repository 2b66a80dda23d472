// Feedback linearization of a body that moves freely in space: thesis (5.29), corrected.
//
//     f = a* - K_v (v - v*) - K_p (p - p*),    alpha = alpha* - K_w (w - w*) + K_r e
//
// (5.29) has no attitude term, so the gaze would drift; e is the rotation vector from the current to the
// desired gaze, in camera axes.
#pragma once

#include "incognita/control/settings.hpp"
#include "incognita/models/sensors/camera_measurement.hpp"

namespace incognita {

/// (5.29) for one state and one reference; accelerations are clamped to the limits. `gaze_rate`,
/// `gaze_acceleration` (alpha*): camera axes.
FreeCameraMotion::Input<double> track_reference(
    const CameraState& estimate, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
    const Eigen::Vector3d& acceleration, const Eigen::Vector4d& gaze, const Eigen::Vector3d& gaze_rate,
    const ControlSettings& settings, const Eigen::Vector3d& gaze_acceleration = Eigen::Vector3d::Zero());

}  // namespace incognita
