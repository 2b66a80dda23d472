#include "incognita/app/loop/observability_watch.hpp"

#include <algorithm>

namespace incognita {
namespace {

using Form = SpatialScene::Landmark::Form;

Form form_of(Landmark::Kind kind) {
  return kind == Landmark::Kind::line            ? Form::ray
         : kind == Landmark::Kind::inverse_depth ? Form::inverse_depth
                                                 : Form::point;
}

PlanarScene scene_of(const TeamEstimate& estimate, const ObservabilityMonitor& monitor) {
  PlanarScene scene;
  scene.vehicle = estimate.belief.mean(estimate.vehicles.front().block);
  scene.errors = monitor.errors();
  for (const auto& [identity, landmark] : estimate.landmarks)
    if (const auto* block = monitor.find(landmark.block))
      scene.landmarks.push_back({identity, block->first, estimate.belief.mean(landmark.block)});
  return scene;
}

/// Without a monitor, as before its first tick, the errors are not numbered.
SpatialScene scene_of(const Estimate& estimate, const ObservabilityMonitor* monitor) {
  SpatialScene scene;
  scene.camera = estimate.camera_state();
  if (monitor) scene.errors = monitor->errors();
  for (const Landmark& landmark : estimate.catalogue) {
    if (landmark.kind == Landmark::Kind::anchor) continue;
    const auto* block = monitor ? monitor->find(landmark.block) : nullptr;
    if (monitor && !block) continue;
    auto& out = scene.landmarks.emplace_back();
    out.id = landmark.id;
    if (block) out.first = block->first;
    out.form = form_of(landmark.kind);
    out.birth_axes = landmark.birth_axes;
    const auto mean = estimate.belief.mean(landmark.block);
    out.mean.head(mean.size()) = mean;
  }
  return scene;
}

constexpr const char* not_finite = "its information is not finite";

std::string why(ObservabilityMonitor::Uncovered uncovered) {
  switch (uncovered) {
    case ObservabilityMonitor::Uncovered::carried:
      return "the map is told in the vehicle's frame";
    case ObservabilityMonitor::Uncovered::decorrelated:
      return "the filter drops correlations";
    case ObservabilityMonitor::Uncovered::other_mover:
      return "more than one vehicle moves";
    case ObservabilityMonitor::Uncovered::not_finite:
      return not_finite;
  }
  return "unknown";
}

bool is_finite(const PlanarScene& scene) { return scene.vehicle.allFinite() && units_of(scene).allFinite(); }
bool is_finite(const SpatialScene& scene) { return scene.camera.allFinite() && units_of(scene).allFinite(); }

bool has_birth(const BeliefTrace& trace) {
  return std::any_of(trace.begin(), trace.end(),
                     [](const BeliefEvent& event) { return std::holds_alternative<BlockBirth>(event); });
}

bool is_finite(const MonitoredInformation& information) {
  return information.Y.allFinite() && information.gathered.allFinite();
}

MonitoredInformation information_of(ObservabilityMonitor& monitor) {
  return {monitor.information(), monitor.gathered()};
}

}  // namespace

void ObservabilityWatch::follow(const AnyBelief& belief, BlockId vehicle) {
  if (!monitor_) monitor_.emplace(vehicle, belief.chart(vehicle).tangent());
  monitor_->follow(belief.trace());
}

/// Both monitors of a camera. Places of birth are exact to a share of the scene, as it is at their birth.
void ObservabilityWatch::follow_camera(const Estimate& estimate) {
  constexpr double exact_share = 5e-5;
  if (!monitor_) {
    const int errors = estimate.belief.chart(estimate.camera).tangent();
    monitor_.emplace(estimate.camera, errors);
    looks_.emplace(estimate.camera, errors, ObservabilityMonitor::Motions::tell_nothing);
  }
  if (has_birth(estimate.belief.trace())) {
    const double length = typical_distance(scene_of(estimate, nullptr));
    monitor_->take_as_exact(SpatialScene::dimension, exact_share * length);
    if (looks_) looks_->take_as_exact(SpatialScene::dimension, exact_share * length);
  }
  monitor_->follow(estimate.belief.trace());
  if (looks_) looks_->follow(estimate.belief.trace());
}

void ObservabilityWatch::follow(const Estimate& estimate) {
  if (!estimate.started) return;
  follow_camera(estimate);
  const std::size_t anchors_before = anchors_.size();
  const bool corrected = estimate.update.outcome == UpdateReport::Outcome::updated;
  for (const Look& look : estimate.looks)
    if (corrected && look.kind == Landmark::Kind::anchor && look.outcome == LookOutcome::matched)
      see_anchor(look.id, look.point);
  if (anchors_.size() > anchors_before &&
      remaining_symmetries(fixed(SpatialScene::dimension).places).basis.cols() == 0)
    looks_.reset();
  put(scene_of(estimate, &*monitor_));
}

void ObservabilityWatch::follow(const TeamEstimate& estimate) {
  if (!estimate.started) return;
  follow(estimate.belief, estimate.vehicles.front().block);
  for (const TeamLook& look : estimate.looks)
    if (look.anchor && look.outcome == LookOutcome::matched)
      see_anchor(look.identity, estimate.anchors.at(look.identity).position);
  for (const UsedFix& fix : estimate.fixes) use_fix(fix);
  put(scene_of(estimate, *monitor_));
}

template <class Scene>
void ObservabilityWatch::put(Scene scene) {
  finite_ = is_finite(scene);
  if (finite_)
    scene_ = std::move(scene);
  else if (!std::holds_alternative<Scene>(scene_))
    scene_ = Scene{};
}

/// Fixes of a vehicle that stands still scatter: only such as are clearly apart are two places.
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
  out.places.resize(dimension, static_cast<Eigen::Index>(anchors_.size() + fixes_.size()));
  Eigen::Index column = 0;
  for (const auto& [id, place] : anchors_) out.places.col(column++) = place;
  for (const Eigen::Vector2d& place : fixes_) out.places.col(column++) = place;
  return out;
}

/// What is not finite is not followed, and what can be known is said of the last scene that was.
std::optional<ObservabilityReport> ObservabilityWatch::report() {
  if (!monitor_) return std::nullopt;
  std::string uncovered = monitor_->uncovered() ? why(*monitor_->uncovered()) : "";
  if (uncovered.empty() && !finite_) uncovered = "the estimate is not finite";
  MonitoredInformation of_filter, of_looks;
  if (uncovered.empty()) {
    of_filter = information_of(*monitor_);
    if (looks_) of_looks = information_of(*looks_);
    if (!is_finite(of_filter) || !is_finite(of_looks)) uncovered = not_finite;
  }
  if (const auto* scene = std::get_if<PlanarScene>(&scene_))
    return observability_report(of_filter, *scene, fixed(PlanarScene::dimension), uncovered);
  return observability_report(of_filter, of_looks, std::get<SpatialScene>(scene_),
                              fixed(SpatialScene::dimension), uncovered);
}

}  // namespace incognita
