// Steers a free camera along its goal by feedback linearisation: thesis (5.29), corrected.
//
//   f = a* - K_v (v - v*) - K_p (p - p*),    alpha = alpha* - K_w (w - w*) + K_r e
//
// (5.29) has no term for the orientation itself, so a gaze would drift; e is the rotation vector from the
// present gaze to the wanted one, in camera axes.
#pragma once

#include <optional>

#include "incognita/control/settings.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/estimate.hpp"

namespace incognita {

/// (5.29) for one state and one reference; accelerations are cut off at what the body can do.
Command track_reference(const CameraState& estimate, const Eigen::Vector3d& position,
                        const Eigen::Vector3d& velocity, const Eigen::Vector3d& acceleration,
                        const Eigen::Vector4d& gaze, const Eigen::Vector3d& gaze_rate,
                        const ControlSettings& settings);

class CameraController {
 public:
  explicit CameraController(const ControlSettings& settings) : settings_(settings) {}

  /// What to do until the next tick. Before the start nothing; when lost, brake from the last known motion,
  /// then nothing.
  Command act(const Estimate& estimate, const Goal& goal, const Tick& tick);

 private:
  Command brake(const Tick& tick) const;

  ControlSettings settings_;
  std::optional<double> first_heading_;
  std::optional<double> first_t_;
  CameraState last_known_ = CameraState::Zero();
  double lost_t_ = -1;
};

}  // namespace incognita
