// Follows an estimator while it runs, so that the run can say what it knows of its frame and scale, and what
// it only believes: analysis/observability/observability_report.hpp.
#pragma once

#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "incognita/analysis/observability/observability_monitor.hpp"
#include "incognita/analysis/observability/observability_report.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/points/team_estimate.hpp"

namespace incognita {

class ObservabilityWatch {
 public:
  /// After each tick, with the trace of that tick alone: Belief::keep_trace().
  void follow(const Estimate& estimate);
  /// Of one vehicle on a plane.
  void follow(const TeamEstimate& estimate);

  /// As of the last tick; nothing while the estimator has not started. Cubic in the map.
  std::optional<ObservabilityReport> report();

 private:
  void follow(const AnyBelief& belief, BlockId vehicle);
  void follow_camera(const Estimate& estimate);
  template <class Scene>
  void put(Scene scene);
  void add_anchor(std::int64_t id, const Eigen::VectorXd& position) { anchors_.emplace(id, position); }
  void use_fix(const UsedFix& fix);
  FixedPoints fixed(Eigen::Index dimension) const;

  std::optional<ObservabilityMonitor> monitor_;
  /// Of a camera, motions telling nothing; given up when no symmetry remains
  std::optional<ObservabilityMonitor> measurement_monitor_;
  std::map<std::int64_t, Eigen::VectorXd> anchors_;                ///< that corrected the filter
  std::vector<Eigen::Vector2d> fixes_;                             ///< places clearly apart
  std::variant<std::monostate, PlanarScene, SpatialScene> scene_;  ///< the last whose numbers are finite
  bool finite_ = true;                                             ///< that is the present one
};

}  // namespace incognita
