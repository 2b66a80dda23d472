// How much of the world is mapped, against the truth of a simulation.
//
// The world consists of parts with weights: patches of the textured surfaces of a room, world/rendered/surface_patches.hpp, by
// their area, or points, each of weight 1. A part is mapped while the map has at least one landmark whose true position lies
// on that part and whose estimate is within 5 cm of its true position. The error is absolute: in the frame in which truth and
// estimate are both given, that of the start target or of the anchors, without any alignment. Known landmarks (anchors) do not
// count. The share can fall: when the estimate of a landmark gets worse, or when the landmark is removed from the map.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace incognita {

/// Largest error of a landmark that maps its part, m.
inline constexpr double mapped_within_m = 0.05;

class MappedShare {
 public:
  /// `weights`: of the parts, positive.
  explicit MappedShare(std::vector<double> weights);

  /// Begins with an empty map.
  void restart();
  /// A landmark of the map whose true position lies on that part; nothing: on none, and it does not count.
  void add(std::optional<std::size_t> part, const Eigen::Vector3d& truth, const Eigen::Vector3d& estimate);

  /// Weight of the mapped parts over that of all; nothing if there are no parts.
  std::optional<double> share() const;

 private:
  std::vector<double> weights_;
  double total_ = 0, mapped_ = 0;
  std::vector<std::int64_t> mapped_in_;  ///< by part, the number of the map that last mapped it
  std::int64_t map_ = 0;                 ///< number of this map
};

}  // namespace incognita
