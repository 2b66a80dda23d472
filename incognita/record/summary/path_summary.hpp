// How long the path of each body of a run is, and how far from the truth it ends.
#pragma once

#include <optional>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Lengths are sums of the distances between successive positions.
struct BodyPath {
  double estimated_length = 0;                 ///< m, or arbitrary units where the scale is unobservable
  std::optional<double> true_length_m;         ///< where the truth was ever known
  bool truth_has_gaps = false;                 ///< not known at some frame with an estimate
  std::optional<StampedPose> estimate, truth;  ///< the last at a time when both were known
};

class PathSummary {
 public:
  void add(const Snapshot& snapshot);
  /// One for each robot of a team, else one alone; none before the first frame.
  const std::vector<BodyPath>& bodies() const { return bodies_; }

 private:
  void add(std::size_t body, const std::optional<StampedPose>& truth,
           const std::optional<StampedPose>& estimate);

  std::vector<BodyPath> bodies_;
  std::vector<std::optional<StampedPose>> last_truth_, last_estimate_;
};

}  // namespace incognita
