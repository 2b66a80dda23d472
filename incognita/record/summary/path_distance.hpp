// True distance of each body from its reference.
#pragma once

#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// True distance between the controlled point (`steered_m`: ahead and left of the body's origin) and its reference; NaN
/// if either is unknown, also by an unknown heading. Planar unless the body flies, since the paths of ground vehicles have no height.
double from_path_m(const SnapshotBody& body, bool flies, const Eigen::Vector2d& steered_m);

/// Over the last third of the run; NaN without a reference or the truth.
struct PathDistance {
  double median_m, p95_m;
};

class PathDistanceSummary {
 public:
  PathDistanceSummary(bool flies, const Eigen::Vector2d& steered_m) : flies_(flies), steered_m_(steered_m) {}

  /// Adds the bodies whose poses are valid.
  void add(const Snapshot& snapshot);

  /// Of `count` bodies.
  std::vector<PathDistance> bodies(std::size_t count) const;

 private:
  bool flies_;
  Eigen::Vector2d steered_m_;
  std::vector<std::vector<double>> from_path_m_;  ///< per body, in time order
};

}  // namespace incognita
