// Steers a free camera along its goal, its gaze level: thesis (5.29), track_reference.hpp.
#pragma once

#include <cstdint>
#include <optional>

#include "incognita/control/person.hpp"
#include "incognita/control/settings.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/estimate.hpp"

namespace incognita {

class CameraController {
 public:
  /// `person`: who may move it by hand instead.
  explicit CameraController(const ControlSettings& settings, const PersonSettings& person = {},
                            std::uint64_t seed = 1);

  /// What to do until the next tick. Before the start nothing; when lost, brake from the last known motion,
  /// then nothing. A person goes by what the hand feels, seen.felt, and not by the estimate.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& seen, const Tick& tick);

 private:
  struct Gaze {
    double heading, rate;  ///< rad, rad/s, to the left
  };
  Gaze gaze_of(const Goal& goal, const Tick& tick);
  Command brake(const Tick& tick) const;

  ControlSettings settings_;
  std::optional<Person> person_;
  std::optional<double> first_heading_;
  std::optional<double> first_t_;
  CameraState last_known_ = CameraState::Zero();
  double lost_t_ = -1;
};

}  // namespace incognita
