// Delayed initialization of the landmarks that a camera detects as points, thesis Section 6.3.1 and C.3.
//
// A detection that matches nothing starts a line: an inverse-depth landmark without its depth (5 errors in the belief), with
// weighted hypotheses of the depth. The detections that match it re-weight the hypotheses and do not correct the filter.
// The landmark enters the map as a point when the standard deviation of its depth is small against the depth. Lines are
// matched after the correction by the map, by identity or to the detection nearest to any of their hypotheses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "incognita/slam/mapper/depth_hypotheses.hpp"

namespace incognita {

class StateArchive;

/// A line of the belief: a landmark of kind `ray`.
struct DepthLine {
  int body = 0, sensor = 0;  ///< that began it, and alone follow it
  std::vector<DepthHypothesis> depths;
  int failures = 0;  ///< consecutive ticks without a match
  void state(StateArchive& archive);
};

class DepthLines {
 public:
  /// After the correction: matches the lines with detections of this tick, converts those of converged depth to points, and
  /// drops those that failed too often or whose match no hypothesis explains. Removes from `candidates` of new landmarks
  /// (indices into FrameReport::matches) those that may belong to a line.
  void follow(Estimate& estimate, std::vector<std::size_t>& candidates, const EstimatorSettings& settings);

  /// Takes up the rays that this tick's detections initialized.
  void take_up(const Estimate& estimate, const EstimatorSettings& settings);

  /// By id of the landmark.
  const std::map<std::int64_t, DepthLine>& lines() const { return lines_; }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  std::map<std::int64_t, DepthLine> lines_;
};

}  // namespace incognita
