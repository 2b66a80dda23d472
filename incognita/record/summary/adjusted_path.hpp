// The trajectory of the only body once its keyframes have been adjusted: each pose estimated also from later images.
#pragma once

#include <map>
#include <optional>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Keyframes are taken as bundle adjustment had them last. The poses between two of them are those of the filter, moved by
/// corrections that are linear in time: from that of the first, relative to its pose in the filter after its first adjustment,
/// to that of the second, relative to its pose before.
class AdjustedPath {
 public:
  void add(const Snapshot& snapshot);
  /// A pose for each frame that has one; empty without adjusted keyframes.
  Trajectory trajectory() const;

 private:
  struct Keyframe {
    StampedPose adjusted;               ///< last
    std::optional<StampedPose> before;  ///< as the filter had it, before the first adjustment
  };

  Trajectory filtered_;
  std::map<double, Keyframe> keyframes_;  ///< by time, s
};

}  // namespace incognita
