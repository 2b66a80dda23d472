// The start of the estimate: it waits until each body has what its start needs, a target in an image or a position fix,
// and then adds all bodies to the belief at the same tick, since landmarks follow the bodies there.
#pragma once

#include <optional>
#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/slam/features/feature_tracker.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class StateArchive;

class EstimatorStart {
 public:
  /// Starts the estimate and the maps of the cameras that have an image. Otherwise the status of the estimate says what
  /// is missing; it is `lost` when a target was not found in time.
  void start(Estimate& estimate, std::vector<FeatureTracker>& cameras, const EstimatorSettings& settings,
             const Observation& observation, const Tick& tick);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  bool has_first_fixes(const EstimatorSettings& settings, const Observation& observation);
  bool has_camera_starts(Estimate& estimate, const std::vector<FeatureTracker>& cameras, double waited_s);
  void add_bodies(Estimate& estimate, const std::vector<FeatureTracker>& cameras,
                  const EstimatorSettings& settings, const Observation& observation, const Tick& tick) const;

  std::vector<FeatureTracker::Start> starts_;                ///< of each camera, until the start
  std::vector<std::optional<PositionReading>> first_fixes_;  ///< of each body that starts at one
};

}  // namespace incognita
