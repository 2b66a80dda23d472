#include "incognita/slam/estimator/estimator_start.hpp"

#include <algorithm>
#include <utility>

#include "incognita/slam/mapper/bodies.hpp"

namespace incognita {
namespace {

double start_time(const BodyModel& model, const BodyObservation& observed,
                  const std::optional<PositionReading>& fix, double t) {
  if (model.start_time == BodyModel::StartTime::first_fix) return fix->t;
  if (model.start_time == BodyModel::StartTime::first_reading && !observed.odometry.empty())
    return std::min(t, observed.odometry.front().t);
  return t;
}

void add_anchors(Estimate& e, const std::map<std::int64_t, SmallVector>& anchors) {
  for (const auto& [id, position] : anchors) {
    Landmark& anchor = e.landmarks[id];
    anchor.id = id;
    anchor.fixed = true;
    anchor.position = position;
    e.next_id = std::max(e.next_id, id + 1);
  }
}

/// An estimate without bodies, whose landmarks are the anchors.
void clear(Estimate& e, const EstimatorSettings& settings) {
  const bool traced = e.belief.keeps_trace();
  e.belief = empty_belief(settings.filter);
  e.belief.keep_trace(traced);
  e.bodies.clear();
  e.landmarks.clear();
  e.lasting_errors.clear();
  e.world.reset();
  e.health = {};
  add_anchors(e, settings.anchors);
}

/// Whether features of cameras need numbers that no sensor reports as an identity.
bool mixes_identities(const EstimatorSettings& settings) {
  return settings.association.method == DataAssociationSettings::Method::known &&
         std::ranges::any_of(settings.bodies, [](const BodyModel& body) { return !body.sensors.empty(); });
}

bool has_target(const std::vector<FeatureTracker>& cameras, std::size_t body) {
  return std::ranges::any_of(cameras, [&](const FeatureTracker& camera) {
    return camera.camera().body == body && camera.has_target();
  });
}

}  // namespace

/// Whether each body that has to wait for a position fix has one, now or from an earlier tick.
bool EstimatorStart::has_first_fixes(const EstimatorSettings& settings, const Observation& observation) {
  first_fixes_.resize(settings.bodies.size());
  bool all = true;
  for (std::size_t i = 0; i < settings.bodies.size(); ++i) {
    if (settings.bodies[i].start_time != BodyModel::StartTime::first_fix) continue;
    if (const auto& fixes = body_of(observation, i).fixes; !fixes.empty()) first_fixes_[i] = fixes.front();
    all = all && first_fixes_[i];
  }
  return all;
}

/// Whether each body with cameras can start: one of its cameras finds the target in its image or, if none of them has a
/// target, has had an image, now or at an earlier tick.
bool EstimatorStart::has_camera_starts(Estimate& e, const std::vector<FeatureTracker>& cameras,
                                       double waited_s) {
  starts_.resize(cameras.size());
  std::vector<std::size_t> ready;
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const FeatureTracker& camera = cameras[k];
    FeatureTracker::Start start = camera.find_start(waited_s);
    if (camera.has_target() || start.ready || !starts_[k].ready) starts_[k] = std::move(start);
    if (starts_[k].ready && (camera.has_target() || !has_target(cameras, camera.camera().body)))
      ready.push_back(camera.camera().body);
  }
  bool all = true;
  for (std::size_t k = 0; all && k < cameras.size(); ++k) {
    all = std::ranges::find(ready, cameras[k].camera().body) != ready.end();
    if (starts_[k].given_up && !all) e.status.state = TrackingState::lost;
    if (!all || starts_[k].pose || k == 0) e.status.reason = starts_[k].reason;
  }
  return all;
}

void EstimatorStart::start(Estimate& e, std::vector<FeatureTracker>& cameras,
                           const EstimatorSettings& settings, const Observation& observation,
                           const Tick& tick) {
  e.status.state = TrackingState::starting;
  if (!has_first_fixes(settings, observation)) {
    e.status.reason = "waiting for the first position fix";
    return;
  }
  if (!has_camera_starts(e, cameras, duration_s(*e.first_t, tick.t, tick.whole_us))) return;
  clear(e, settings);
  if (!cameras.empty() && mixes_identities(settings)) e.next_id = first_feature_number;
  add_bodies(e, cameras, settings, observation, tick);
  for (FeatureTracker& camera : cameras) camera.start_lasting_errors(e);
  e.started = true;
  e.status.state = TrackingState::tracking;
  if (cameras.empty()) e.status.reason.clear();
  for (Body& body : e.bodies) body.status = e.status;
  for (std::size_t k = 0; k < cameras.size(); ++k)
    if (cameras[k].has_image())
      cameras[k].start_map(e, starts_[k].pose, settings.bodies[cameras[k].camera().body].motion);
}

void EstimatorStart::add_bodies(Estimate& e, const std::vector<FeatureTracker>& cameras,
                                const EstimatorSettings& settings, const Observation& observation,
                                const Tick& tick) const {
  for (std::size_t i = 0; i < settings.bodies.size(); ++i) {
    const BodyModel& model = settings.bodies[i];
    SmallVector at = model.start;
    SmallMatrix P = model.start_sigmas.cwiseAbs2().asDiagonal();
    if (model.start_time == BodyModel::StartTime::first_fix) at.head<2>() = first_fixes_[i]->position;
    for (std::size_t k = 0; k < cameras.size(); ++k) {
      if (cameras[k].camera().body != i || !starts_[k].pose) continue;
      at.head<3>() = starts_[k].pose->position;
      at.segment<4>(3) = starts_[k].pose->world_from_camera;
      P.topLeftCorner<6, 6>() = cameras[k].start_cov(*starts_[k].pose);
    }
    add_body(e, model, at, P, start_time(model, body_of(observation, i), first_fixes_[i], tick.t),
             settings.filter.map_frame == MapFrame::vehicle);
    if (model.start_time == BodyModel::StartTime::first_fix) e.bodies.back().first_fix_t = first_fixes_[i]->t;
  }
}

}  // namespace incognita
