// The next translation of a free camera: the one that teaches most (thesis 6.2, 6.3.1).
#pragma once

#include <vector>

#include "incognita/decision/actions.hpp"
#include "incognita/decision/information.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/estimate.hpp"
#include "incognita/slam/settings.hpp"

namespace incognita {

class CameraDecision {
 public:
  CameraDecision(Camera camera, const CameraSlamSettings& slam, const DecisionSettings& settings);

  /// Scores every action in every frame; compares them, and sets a new goal, once per period. Actions that
  /// would end outside the bounds are scored but not chosen. Without a pose to start from (starting, lost)
  /// there is no action.
  Goal choose(const Estimate& estimate, const Tick& tick);

  const std::vector<Translation>& actions() const { return actions_; }

 private:
  double score(const Estimate& estimate, const CameraState& after, const ImaginedMotion& motion);
  void decide(const CameraState& now, const Tick& tick);

  Camera camera_;
  CameraSlamSettings slam_;
  DecisionSettings settings_;
  std::vector<Translation> actions_;
  Goal goal_;
  MutualInformation information_;
  std::vector<AffineLook> looks_;
};

}  // namespace incognita
