// Deletion of landmarks that the point sensors do not detect again: spurious detections, duplicates, and what has gone.
//
// A landmark is expected at a scan when its predicted measurement lies well inside those that the sensor has matched so far, and
// within the range and field of view of the settings. Detections beyond are rare, and a recording does not say how
// far its sensor reaches. A landmark that was detected in fewer than `min_detected_share` of at least
// `min_expected_scans` such scans is deleted. Scans in which the body matched nothing count for none: its pose may be wrong.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

class StateArchive;

class LandmarkPruning {
 public:
  /// Counts by the matches of this tick, after the correction, and deletes. Never anchors, features of cameras, and landmarks
  /// whose sensors report identities. Linear in the map.
  void update(Estimate& estimate, const EstimatorSettings& settings);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  /// The measurements that a sensor of a body matched so far, by rows: the smallest and the largest numbers.
  struct Reach {
    SmallVector least, most;
    void extend(const SmallVector& z);
    bool is_well_inside(const SmallVector& z) const;
    void state(StateArchive& archive);
  };

  void extend_reaches(const Estimate& estimate);
  void count(Estimate& estimate, int body, int sensor, const EstimatorSettings& settings);
  static void prune(Estimate& estimate, const PruningSettings& settings);

  std::vector<std::vector<Reach>> reaches_;  ///< by body and sensor
  std::vector<std::int64_t> matched_;        ///< workspace: by one sensor at this tick, sorted
};

}  // namespace incognita
