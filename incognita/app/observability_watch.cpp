#include "incognita/app/observability_watch.hpp"

#include <algorithm>

namespace incognita {
namespace {

using Form = SpatialScene::Landmark::Form;

Form form_of(Landmark::Kind kind) {
  return kind == Landmark::Kind::line            ? Form::ray
         : kind == Landmark::Kind::inverse_depth ? Form::inverse_depth
                                                 : Form::point;
}

PlanarScene scene_of(const PlanarEstimate& estimate, const ObservabilityMonitor& monitor) {
  PlanarScene scene;
  scene.vehicle = estimate.belief.mean(estimate.vehicle);
  scene.errors = monitor.errors();
  for (const PlanarLandmark& landmark : estimate.catalogue) {
    const auto* block = landmark.anchor ? nullptr : monitor.find(landmark.block);
    if (block) scene.landmarks.push_back({landmark.id, block->first, estimate.belief.mean(landmark.block)});
  }
  return scene;
}

SpatialScene scene_of(const Estimate& estimate, const ObservabilityMonitor& monitor) {
  SpatialScene scene;
  scene.camera = estimate.camera_state();
  scene.errors = monitor.errors();
  for (const Landmark& landmark : estimate.catalogue) {
    const auto* block = landmark.kind == Landmark::Kind::anchor ? nullptr : monitor.find(landmark.block);
    if (!block) continue;
    auto& out = scene.landmarks.emplace_back();
    out.id = landmark.id;
    out.first = block->first;
    out.form = form_of(landmark.kind);
    out.birth_axes = landmark.birth_axes;
    out.mean.head(block->errors) = estimate.belief.mean(landmark.block);
  }
  return scene;
}

std::string why(ObservabilityMonitor::Uncovered uncovered) {
  switch (uncovered) {
    case ObservabilityMonitor::Uncovered::carried:
      return "the map is told in the vehicle's frame";
    case ObservabilityMonitor::Uncovered::decorrelated:
      return "the filter drops correlations";
    case ObservabilityMonitor::Uncovered::other_mover:
      return "more than one vehicle moves";
  }
  return "unknown";
}

bool scene_is_finite(const std::variant<std::monostate, PlanarScene, SpatialScene>& scene) {
  if (const auto* planar = std::get_if<PlanarScene>(&scene))
    return planar->vehicle.allFinite() && units_of(*planar).allFinite();
  const auto& spatial = std::get<SpatialScene>(scene);
  return spatial.camera.allFinite() && units_of(spatial).allFinite();
}

}  // namespace

void ObservabilityWatch::follow(const Belief& belief, BlockId vehicle) {
  if (!monitor_) monitor_.emplace(vehicle, belief.chart(vehicle).tangent());
  monitor_->follow(belief.trace());
}

void ObservabilityWatch::follow(const Estimate& estimate) {
  if (!estimate.started) return;
  follow(estimate.belief, estimate.camera);
  const bool corrected = estimate.update.outcome == UpdateReport::Outcome::updated;
  for (const Look& look : estimate.looks)
    if (corrected && look.kind == Landmark::Kind::anchor && look.outcome == LookOutcome::matched)
      see_anchor(look.id, look.point);
  scene_ = scene_of(estimate, *monitor_);
}

void ObservabilityWatch::follow(const PlanarEstimate& estimate) {
  if (!estimate.started) return;
  follow(estimate.belief, estimate.vehicle);
  for (const PlanarLook& look : estimate.looks) {
    if (!look.anchor || look.outcome != LookOutcome::matched) continue;
    for (const PlanarLandmark& landmark : estimate.catalogue)
      if (landmark.anchor && landmark.id == look.id) see_anchor(look.id, landmark.position);
  }
  for (const UsedFix& fix : estimate.fixes) use_fix(fix);
  scene_ = scene_of(estimate, *monitor_);
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

std::optional<ObservabilityReport> ObservabilityWatch::report() {
  if (!monitor_) return std::nullopt;
  const std::string uncovered = monitor_->uncovered() ? why(*monitor_->uncovered()) : "";
  const Eigen::MatrixXd Y = uncovered.empty() ? monitor_->information() : Eigen::MatrixXd();
  if (!Y.allFinite() || !scene_is_finite(scene_)) return std::nullopt;
  if (const auto* scene = std::get_if<PlanarScene>(&scene_))
    return observability_report(Y, *scene, fixed(PlanarScene::dimension), uncovered);
  return observability_report(Y, std::get<SpatialScene>(scene_), fixed(SpatialScene::dimension), uncovered);
}

}  // namespace incognita
