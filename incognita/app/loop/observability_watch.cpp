#include "incognita/app/loop/observability_watch.hpp"

#include <algorithm>
#include <string>

namespace incognita {
namespace {

using Form = SpatialScene::Landmark::Form;

Form form_of(LandmarkParametrization::Kind kind) {
  return kind == LandmarkParametrization::Kind::ray             ? Form::ray
         : kind == LandmarkParametrization::Kind::inverse_depth ? Form::inverse_depth
                                                                : Form::point;
}

PlanarScene planar_scene_of(const Estimate& estimate, const ObservabilityMonitor& monitor) {
  PlanarScene scene;
  scene.vehicles.clear();
  for (const Body& body : estimate.bodies) scene.vehicles.emplace_back(estimate.belief.mean(body.block));
  scene.errors = monitor.errors();
  for (const auto& [id, landmark] : estimate.landmarks)
    if (const auto* block = landmark.fixed ? nullptr : monitor.find(landmark.block))
      scene.landmarks.push_back({id, block->first, estimate.belief.mean(landmark.block)});
  return scene;
}

/// Without a monitor (before its first tick), error indices are unset.
SpatialScene spatial_scene_of(const Estimate& estimate, const ObservabilityMonitor* monitor) {
  SpatialScene scene;
  scene.camera = estimate.camera_state();
  if (monitor) scene.errors = monitor->errors();
  for (const auto& [id, landmark] : estimate.landmarks) {
    if (landmark.fixed) continue;
    const auto* block = monitor ? monitor->find(landmark.block) : nullptr;
    if (monitor && !block) continue;
    auto& out = scene.landmarks.emplace_back();
    out.id = id;
    if (block) out.first = block->first;
    out.form = form_of(landmark.form.kind);
    out.initial_axes = InverseDepthLandmark{landmark.form.initial_axes};
    const auto mean = estimate.belief.mean(landmark.block);
    out.mean.head(mean.size()) = mean;
  }
  return scene;
}

std::vector<ObservabilityMonitor::Vehicle> vehicles_of(const Estimate& estimate) {
  std::vector<ObservabilityMonitor::Vehicle> vehicles;
  for (const Body& body : estimate.bodies)
    vehicles.push_back({body.block, estimate.belief.chart(body.block).tangent()});
  return vehicles;
}

constexpr int most_errors = 900;
constexpr const char* not_finite = "the filter's information is not finite";

std::string why(ObservabilityMonitor::Uncovered uncovered) {
  switch (uncovered) {
    case ObservabilityMonitor::Uncovered::frame_changed:
      return "the map is expressed in the vehicle frame, or a loop was closed";
    case ObservabilityMonitor::Uncovered::decorrelated:
      return "the filter decorrelates its map";
    case ObservabilityMonitor::Uncovered::other_block:
      return "a block other than a body moved";
    case ObservabilityMonitor::Uncovered::not_finite:
      return not_finite;
  }
  return "unknown";
}

bool is_finite(const PlanarScene& scene) {
  return units_of(scene).allFinite() && std::all_of(scene.vehicles.begin(), scene.vehicles.end(),
                                                    [](const auto& vehicle) { return vehicle.allFinite(); });
}
bool is_finite(const SpatialScene& scene) { return scene.camera.allFinite() && units_of(scene).allFinite(); }

bool is_initialized(const BeliefTrace& trace) {
  return std::any_of(trace.begin(), trace.end(), [](const BeliefEvent& event) {
    return std::holds_alternative<BlockAugmentation>(event);
  });
}

bool is_finite(const MonitoredInformation& information) {
  return information.Y.allFinite() && information.gathered.allFinite();
}

MonitoredInformation information_of(ObservabilityMonitor& monitor) {
  return {monitor.information(), monitor.gathered()};
}

}  // namespace

/// Updates both monitors of a camera. Initialization poses are regularized with a sigma proportional to the
/// scene's size at that time.
void ObservabilityWatch::follow_camera(const Estimate& estimate) {
  constexpr double exact_share = 5e-5;
  if (!monitor_) {
    monitor_.emplace(vehicles_of(estimate));
    measurement_monitor_.emplace(vehicles_of(estimate), ObservabilityMonitor::Motions::uninformative);
    for (const BlockId block : estimate.lasting_errors) {
      monitor_->treat_as_noise(block, estimate.belief.covariance(block));
      measurement_monitor_->treat_as_noise(block, estimate.belief.covariance(block));
    }
  }
  if (is_initialized(estimate.belief.trace())) {
    const double length = typical_distance(spatial_scene_of(estimate, nullptr));
    monitor_->set_exact_position(SpatialScene::dimension, exact_share * length);
    if (measurement_monitor_)
      measurement_monitor_->set_exact_position(SpatialScene::dimension, exact_share * length);
  }
  monitor_->follow(estimate.belief.trace());
  if (measurement_monitor_) measurement_monitor_->follow(estimate.belief.trace());
}

void ObservabilityWatch::follow_planar(const Estimate& estimate) {
  if (!monitor_) monitor_.emplace(vehicles_of(estimate));
  monitor_->follow(estimate.belief.trace());
}

void ObservabilityWatch::use_anchors(const Estimate& estimate) {
  if (estimate.last.update.outcome != UpdateReport::Outcome::updated) return;
  for (const Match& match : estimate.last.matches)
    if (match.anchor && match.outcome == MatchOutcome::matched)
      anchors_.emplace(match.id, estimate.landmarks.at(match.id).position);
}

/// The cost of a tick grows with the square of the map: 5 to 9 ms near the limit, in single ticks up to 90 ms.
bool ObservabilityWatch::exceeds_limit(const Estimate& estimate) {
  too_large_ = too_large_ || estimate.belief.errors() > most_errors;
  if (!too_large_) return false;
  measurement_monitor_.reset();
  if (!monitor_) monitor_.emplace(vehicles_of(estimate));
  return true;
}

void ObservabilityWatch::follow(const Estimate& estimate) {
  if (!estimate.started) return;
  const bool in_space =
      estimate.belief.chart(estimate.body().block).ambient() == FreeCameraMotion::state_size;
  if (exceeds_limit(estimate)) {
    // From the first tick on: the report still says what the sensors and anchors allow
    if (!std::holds_alternative<std::monostate>(scene_)) return;
    use_anchors(estimate);
    return in_space ? put(spatial_scene_of(estimate, nullptr)) : put(PlanarScene{});
  }
  if (in_space)
    follow_camera(estimate);
  else
    follow_planar(estimate);
  const std::size_t anchors_before = anchors_.size();
  use_anchors(estimate);
  for (const UsedFix& fix : estimate.last.fixes) use_fix(fix);
  if (!in_space) return put(planar_scene_of(estimate, *monitor_));
  if (anchors_.size() > anchors_before &&
      remaining_symmetries(fixed(SpatialScene::dimension).positions).basis.cols() == 0)
    measurement_monitor_.reset();
  put(spatial_scene_of(estimate, &*monitor_));
}

template <class Scene>
void ObservabilityWatch::put(Scene scene) {
  finite_ = is_finite(scene);
  if (finite_)
    scene_ = std::move(scene);
  else if (!std::holds_alternative<Scene>(scene_))
    scene_ = Scene{};
}

/// Fixes of a vehicle at rest scatter: only clearly distinct ones count as different positions.
void ObservabilityWatch::use_fix(const UsedFix& fix) {
  constexpr std::size_t most = 8;
  constexpr double apart_sigmas = 7;
  const bool near = std::any_of(fixes_.begin(), fixes_.end(), [&](const Eigen::Vector2d& known) {
    return (known - fix.position).norm() <= apart_sigmas * fix.sigma_m;
  });
  if (!near && fixes_.size() < most) fixes_.push_back(fix.position);
}

FixedPoints ObservabilityWatch::fixed(Eigen::Index dimension) const {
  FixedPoints out;
  out.anchors = static_cast<int>(anchors_.size());
  out.position_fixes = !fixes_.empty();
  out.positions.resize(dimension, static_cast<Eigen::Index>(anchors_.size() + fixes_.size()));
  Eigen::Index column = 0;
  for (const auto& [id, position] : anchors_) out.positions.col(column++) = position;
  for (const Eigen::Vector2d& position : fixes_) out.positions.col(column++) = position;
  return out;
}

/// If the estimate is not finite, the report refers to the last finite scene.
std::optional<ObservabilityReport> ObservabilityWatch::report() {
  if (!monitor_) return std::nullopt;
  std::string uncovered = monitor_->uncovered() ? why(*monitor_->uncovered()) : "";
  if (too_large_)
    uncovered =
        "the state had more than " + std::to_string(most_errors) + " errors, the limit of this analysis";
  if (uncovered.empty() && !finite_) uncovered = "the estimate is not finite";
  MonitoredInformation of_filter, of_measurements;
  if (uncovered.empty()) {
    of_filter = information_of(*monitor_);
    if (measurement_monitor_) of_measurements = information_of(*measurement_monitor_);
    if (!is_finite(of_filter) || !is_finite(of_measurements)) uncovered = not_finite;
  }
  if (const auto* scene = std::get_if<PlanarScene>(&scene_))
    return observability_report(of_filter, *scene, fixed(PlanarScene::dimension), uncovered);
  return observability_report(of_filter, of_measurements, std::get<SpatialScene>(scene_),
                              fixed(SpatialScene::dimension), uncovered);
}

}  // namespace incognita
