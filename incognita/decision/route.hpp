// Progress of a body along a closed path of straight legs.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "incognita/decision/action_rule.hpp"

namespace incognita {

/// A leg on which the body makes no progress is given up: the body then goes to the end of the next one.
class Route {
 public:
  explicit Route(const Mobility& mobility);

  /// Starts at `from`, a point of the first leg, which ends at `points[first]`; the path is closed. At least one point.
  void start(std::vector<Eigen::Vector3d> points, std::size_t first, const Eigen::Vector3d& from);
  bool started() const { return !points_.empty(); }

  /// The point to aim at, a little further along the path. To be called once per decision.
  Eigen::Vector3d next(const Eigen::Vector3d& position);

  void state(StateArchive& archive);

 private:
  double progress_m(const Eigen::Vector3d& position) const;
  double length_m() const;
  void begin_leg(const Eigen::Vector3d& from);

  double reach_m_, ahead_m_;
  int patience_;  ///< decisions without progress after which a leg is given up
  std::vector<Eigen::Vector3d> points_;
  std::size_t to_ = 0;             ///< index of the point where the leg ends
  Eigen::Vector3d from_{0, 0, 0};  ///< where it began
  double most_m_ = 0;              ///< most progress on the leg
  int stalled_ = 0;                ///< decisions since then
};

}  // namespace incognita
