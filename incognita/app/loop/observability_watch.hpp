// Monitors the observability of frame and scale during a run, to distinguish real from spurious information:
// analysis/observability/observability_report.hpp.
#pragma once

#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "incognita/analysis/observability/observability_monitor.hpp"
#include "incognita/analysis/observability/observability_report.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class StateArchive;

class ObservabilityWatch {
 public:
  /// Call after each tick, with the trace of that tick only: Belief::keep_trace().
  /// One free camera that maps by its images, or vehicles on a plane with range-bearing sensors.
  void follow(const Estimate& estimate);

  /// Report at the last tick; nullopt before the estimator has started. Cost is cubic in the map size.
  std::optional<ObservabilityReport> report();

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  bool exceeds_limit(const Estimate& estimate);
  void follow_planar(const Estimate& estimate);
  void follow_camera(const Estimate& estimate);
  void use_anchors(const Estimate& estimate);
  template <class Scene>
  void put(Scene scene);
  void use_fix(const UsedFix& fix);
  FixedPoints fixed(Eigen::Index dimension) const;

  std::optional<ObservabilityMonitor> monitor_;
  /// For a camera: information of the measurements alone, without motion; dropped when no symmetry remains.
  std::optional<ObservabilityMonitor> measurement_monitor_;
  std::map<std::int64_t, Eigen::VectorXd> anchors_;                ///< anchors that corrected the filter
  std::vector<Eigen::Vector2d> fixes_;                             ///< clearly distinct positions only
  std::variant<std::monostate, PlanarScene, SpatialScene> scene_;  ///< the last finite one
  bool too_large_ = false;                                         ///< the map was, once
  bool finite_ = true;                                             ///< whether the current scene is finite
};

}  // namespace incognita
