// Steers a free camera along its goal, its gaze level: thesis (5.29), track_reference.hpp.
#pragma once

#include <optional>

#include "incognita/control/settings.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/estimate.hpp"

namespace incognita {

class CameraController {
 public:
  explicit CameraController(const ControlSettings& settings) : settings_(settings) {}

  /// What to do until the next tick. Before the start nothing; when lost, brake from the last known motion,
  /// then nothing.
  Command act(const Estimate& estimate, const Goal& goal, const Tick& tick);

 private:
  struct Gaze {
    double heading, rate;  ///< rad, rad/s, to the left
  };
  Gaze gaze_of(const Goal& goal, const Tick& tick);
  Command brake(const Tick& tick) const;

  ControlSettings settings_;
  std::optional<double> first_heading_;
  std::optional<double> first_t_;
  CameraState last_known_ = CameraState::Zero();
  double lost_t_ = -1;
};

}  // namespace incognita
