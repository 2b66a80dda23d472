// Steers a free camera along its goal with a level gaze: thesis (5.29), track_reference.hpp.
#pragma once

#include <optional>

#include "incognita/control/controller.hpp"
#include "incognita/control/settings.hpp"

namespace incognita {

class CameraController final : public Controller {
 public:
  /// `operator_controlled`: an operator holds the camera and is shown the goal.
  explicit CameraController(const ControlSettings& settings, bool operator_controlled = false);

  /// Command until the next tick. Empty before the start; when lost, it brakes from the last known motion,
  /// then is empty.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
              const Tick& tick) override;

 private:
  Heading gaze_of(const Goal& goal, const Tick& tick);
  Command brake(const Tick& tick) const;

  ControlSettings settings_;
  bool operator_controlled_;
  std::optional<double> first_heading_;
  std::optional<double> first_t_;
  CameraState last_known_ = CameraState::Zero();
  std::optional<double> lost_t_;
};

}  // namespace incognita
