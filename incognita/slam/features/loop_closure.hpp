// Loop closure after drift: landmarks that return are in the image, but not where the estimate expects them. They are recognized
// as by a lost camera, in a map of those alone that were out of view. The pose that they give shows the drift.
#pragma once

#include <optional>
#include <vector>

#include "incognita/slam/features/relocalization.hpp"
#include "incognita/slam/mapper/drift.hpp"

namespace incognita {

struct ClosedLoop {
  Drift drift;
  std::vector<DriftingLandmark> landmarks;  ///< of this camera, that moved with it
};

class LoopClosure {
 public:
  explicit LoopClosure(std::uint64_t seed) : returning_(seed) {}

  /// One frame of a camera that tracks, after its search, at time `t`, s. A loop once as many consecutive frames as
  /// RelocalizationSettings asks for confirmed the pose; nothing otherwise. Landmarks are recognized only while landmarks that return are
  /// searched for and not found.
  std::optional<ClosedLoop> find(const SummedImage& image, const Estimate& estimate,
                                 const TrackedCamera& camera, double t);

 private:
  Relocalization returning_;
  int frames_until_search_ = 0;
};

/// Number of matches of this frame whose landmarks were out of view.
int returning_matches(const TrackedCamera& camera);

}  // namespace incognita
