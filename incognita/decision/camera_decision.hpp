// The next move of a camera that maps by its images: the one that teaches most (thesis 6.2, 6.3.1).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incognita/decision/camera_expectation.hpp"
#include "incognita/decision/exploration.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/estimate.hpp"
#include "incognita/slam/settings.hpp"

namespace incognita {

class CameraDecision {
 public:
  /// Throws std::invalid_argument where the settings can not be.
  CameraDecision(Camera camera, const CameraSlamSettings& slam, const DecisionSettings& settings,
                 const ExplorationSettings& exploration = {}, std::uint64_t seed = 1);

  /// Scores every action in every frame; compares them, and sets a new goal, once per period. Actions that
  /// would end outside the bounds are scored but not chosen. Without a pose to start from (starting, lost)
  /// there is no action.
  Goal choose(const Estimate& estimate, const Tick& tick);

  /// Names of the actions.
  const std::vector<std::string>& actions() const { return choice_.names(); }

 private:
  void explore(const Estimate& estimate, const Tick& tick);

  CameraExpectation expectation_;
  Exploration exploration_;
  FreeCameraChoice choice_;
  Goal goal_;
  double entropy_due_t_ = 0;  ///< s, when the extended entropy is worked out again
};

/// Entropy in nats of the camera, the points of the map, and those expected and not mapped yet: the extended
/// covariance of Figure 6.3, whose dimension is the same whatever was mapped. Landmarks are told as points,
/// by first order. Not a number where the covariance is not positive definite. Cubic in the map.
double extended_entropy(const Estimate& estimate, const ExplorationSettings& exploration);

}  // namespace incognita
