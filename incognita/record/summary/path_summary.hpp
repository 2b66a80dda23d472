// Path length and final pose of each body of a run.
#pragma once

#include <optional>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Lengths are sums of the distances between successive positions.
struct BodyPath {
  double estimated_length = 0;                 ///< m, or arbitrary units if the scale is unobservable
  std::optional<double> true_length_m;         ///< if the truth was ever known
  bool truth_has_gaps = false;                 ///< unknown at some frame with an estimate
  std::optional<StampedPose> estimate, truth;  ///< the last pair known at the same time
};

class PathSummary {
 public:
  void add(const Snapshot& snapshot);
  /// One entry per body; empty before the first frame.
  const std::vector<BodyPath>& bodies() const { return bodies_; }

 private:
  void add(std::size_t body, const std::optional<StampedPose>& truth,
           const std::optional<StampedPose>& estimate);

  std::vector<BodyPath> bodies_;
  std::vector<std::optional<StampedPose>> last_truth_, last_estimate_;
};

}  // namespace incognita
