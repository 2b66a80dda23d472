// The true positions of the landmarks of a simulated run, and how much of its world is mapped; for evaluation only.
#pragma once

#include <optional>

#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/slam/mapper/estimator.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

/// Follows a run from its first tick or from a saved one. The frame of the estimate must be that of the truth.
class MapTruth : public SavedPart {
 public:
  /// Puts SnapshotLandmark::truth of the landmarks and Snapshot::mapped into the snapshot of this tick. `truth`: of the bodies.
  virtual void put(const std::optional<Truth>& truth, const Estimator& estimator, Snapshot& snapshot) = 0;
};

}  // namespace incognita
