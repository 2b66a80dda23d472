// The trajectory of the only body once its keyframes have been adjusted: each pose estimated also from later images.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Keyframes are taken as bundle adjustment had them last. The poses between two of them are those of the filter, moved by
/// corrections that grow with the path: from that of the first, relative to its pose in the filter after its first adjustment,
/// to that of the second, relative to its pose before. A camera that stands between them is not moved.
class AdjustedPath {
 public:
  void add(const Snapshot& snapshot);
  /// A pose for each frame that has one; empty without adjusted keyframes.
  Trajectory trajectory() const;

 private:
  struct Filtered {
    StampedPose pose;
    double traveled_m = 0;  ///< by the filter since its first pose, without what adjustments moved
  };
  struct Keyframe {
    StampedPose adjusted;            ///< last
    std::optional<Filtered> before;  ///< as the filter had it, before the first adjustment
  };

  std::vector<Filtered> filtered_;
  std::map<double, Keyframe> keyframes_;  ///< by time, s
};

}  // namespace incognita
