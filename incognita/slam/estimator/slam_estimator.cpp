#include "incognita/slam/estimator/slam_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/slam/mapper/bodies.hpp"
#include "incognita/slam/mapper/correction.hpp"
#include "incognita/slam/mapper/health.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/slam/mapper/prediction.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"

namespace incognita {
namespace {

std::string problem_of_camera(const FeatureTracker& camera, const EstimatorSettings& s) {
  const TrackedCamera& c = camera.camera();
  if (c.body >= s.bodies.size())
    return "a camera is on body " + std::to_string(c.body + 1) + ", which does not exist";
  if (!c.mount && !std::holds_alternative<FreeCameraMotion>(s.bodies[c.body].motion))
    return "a camera on a vehicle needs its mount";
  if (s.filter.map_frame == MapFrame::vehicle)
    return "estimator.map_frame = `vehicle`: images are tracked in a map in the world frame; take `world`";
  if (s.filter.linearization == Linearization::first_estimate)
    return "first-estimate Jacobians are derived for ranges and bearings on a plane only, not for images";
  return "";
}

std::string problem_of(const EstimatorSettings& settings, const std::vector<FeatureTracker>& cameras) {
  std::string problem = validate(settings);
  for (std::size_t k = 0; problem.empty() && k < cameras.size(); ++k)
    problem = problem_of_camera(cameras[k], settings);
  return problem;
}

}  // namespace

SlamEstimator::SlamEstimator(EstimatorSettings settings, std::vector<FeatureTracker> cameras)
    : settings_(std::move(settings)), cameras_(std::move(cameras)) {
  const std::string problem = problem_of(settings_, cameras_);
  if (!problem.empty()) throw std::invalid_argument(problem);
  for (std::size_t k = 0; k < cameras_.size(); ++k) cameras_[k].set_index(static_cast<int>(k));
}

namespace {

void check_size(const Observation& observation, std::size_t bodies) {
  if (observation.bodies.empty() || observation.bodies.size() == bodies) return;
  throw std::invalid_argument("observations of " + std::to_string(observation.bodies.size()) +
                              " vehicles were given to an estimator of " + std::to_string(bodies));
}

}  // namespace

void SlamEstimator::update(Estimate& e, const Command& command, const Observation& observation,
                           const Tick& tick) {
  check_size(observation, settings_.bodies.size());
  StageClock stage(e.timing_ms);
  e.last.restart();
  if (!e.first_t) e.first_t = tick.t;
  see(observation);
  stage.mark("sums");
  const bool starts = !e.started;
  if (starts) start(e, observation, tick);
  stage.mark("start");
  if (!e.started) return;
  const bool tracks = !cameras_.empty() && !starts;
  const bool was_lost = tracks && e.status.state == TrackingState::lost;
  predict(e, command, observation, tick, was_lost);
  stage.mark("predict");
  if (tracks) match_images(e, was_lost, stage);
  associate_detections(e, observation, settings_, inliers_);
  stage.mark("associate");
  const bool corrected = correct(e);
  stage.mark("update");
  update_map(e, stage);
  update_poses(e);
  if (was_lost)
    relocate(e, corrected);
  else if (tracks || cameras_.empty())
    assess(e);
  stage.mark("poses");
  if (tracks && !was_lost && e.status.state != TrackingState::lost && e.health.frames_with_few == 0)
    for (FeatureTracker& camera : cameras_) camera.maintain_map(e);
  report(e);
  stage.mark("map");
  refresh_entropy(e, tick.t);
  stage.mark("entropy");
}

void SlamEstimator::see(const Observation& observation) {
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const std::size_t body = cameras_[k].camera().body;
    const auto before = std::count_if(cameras_.begin(), cameras_.begin() + static_cast<std::ptrdiff_t>(k),
                                      [&](const FeatureTracker& c) { return c.camera().body == body; });
    cameras_[k].see(image_of(body_of(observation, body), static_cast<std::size_t>(before)).get());
  }
}

// ---- Start

namespace {

double start_time(const BodyModel& model, const BodyObservation& observed, double t) {
  if (model.start_time == BodyModel::StartTime::first_fix) return observed.fixes.front().t;
  if (model.start_time == BodyModel::StartTime::first_reading && !observed.odometry.empty())
    return std::min(t, observed.odometry.front().t);
  return t;
}

bool waits_for_fix(const BodyModel& model, const BodyObservation& observed) {
  return model.start_time == BodyModel::StartTime::first_fix && observed.fixes.empty();
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

}  // namespace

/// Starts all bodies at the same tick, since landmarks follow the bodies in the belief.
void SlamEstimator::start(Estimate& e, const Observation& observation, const Tick& tick) {
  e.status.state = TrackingState::starting;
  for (std::size_t i = 0; i < settings_.bodies.size(); ++i)
    if (waits_for_fix(settings_.bodies[i], body_of(observation, i))) {
      e.status.reason = "waiting for the first position fix";
      return;
    }
  std::vector<FeatureTracker::Start> starts;
  for (const FeatureTracker& camera : cameras_) {
    starts.push_back(camera.find_start(tick.t - *e.first_t));
    e.status.reason = starts.back().reason;
    if (starts.back().given_up) e.status.state = TrackingState::lost;
    if (!starts.back().ready) return;
  }
  const bool traced = e.belief.keeps_trace();
  e.belief = empty_belief(settings_.filter);
  e.bodies.clear();
  e.landmarks.clear();
  e.world.reset();
  e.health = {};
  e.belief.keep_trace(traced);
  add_anchors(e, settings_.anchors);
  add_bodies(e, observation, tick, starts);
  e.started = true;
  e.status.state = TrackingState::tracking;
  if (cameras_.empty()) e.status.reason.clear();
  for (std::size_t k = 0; k < cameras_.size(); ++k)
    cameras_[k].start_map(e, starts[k].pose, motion_of(cameras_[k]));
}

void SlamEstimator::add_bodies(Estimate& e, const Observation& observation, const Tick& tick,
                               const std::vector<FeatureTracker::Start>& starts) const {
  for (std::size_t i = 0; i < settings_.bodies.size(); ++i) {
    const BodyModel& model = settings_.bodies[i];
    SmallVector at = model.start;
    SmallMatrix P = model.start_sigmas.cwiseAbs2().asDiagonal();
    if (model.start_time == BodyModel::StartTime::first_fix)
      at.head<2>() = body_of(observation, i).fixes.front().position;
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      if (cameras_[k].camera().body != i || !starts[k].pose) continue;
      at.head<3>() = starts[k].pose->position;
      at.segment<4>(3) = starts[k].pose->world_from_camera;
      P.topLeftCorner<6, 6>() = starts[k].pose->covariance;
    }
    add_body(e, model, at, P, start_time(model, body_of(observation, i), tick.t),
             settings_.filter.map_frame == MapFrame::vehicle);
  }
}

// ---- Prediction and matching

namespace {

/// The commanded input of a body; zero without one, and for a camera whose carrier is commanded.
SmallVector commanded_input(const Command& command, std::size_t body, const AnyMotion& motion) {
  const SmallVector& input = command_of(command, body).input;
  return input.size() == inputs_of(motion) ? input : SmallVector(SmallVector::Zero(inputs_of(motion)));
}

}  // namespace

/// `waits_in_place`: bodies with cameras stay where they were lost.
void SlamEstimator::predict(Estimate& e, const Command& command, const Observation& observation,
                            const Tick& tick, bool waits_in_place) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    const BodyObservation& observed = body_of(observation, i);
    const BodyModel& model = settings_.bodies[i];
    e.bodies[i].wheels.reset();
    if (traits_of(model.motion).in_space() && !observed.odometry.empty())
      e.bodies[i].wheels = observed.odometry.back().input;
    if (waits_in_place && carries_camera(i))
      e.bodies[i].t = tick.t;
    else
      predict_body(e, i, commanded_input(command, i, model.motion), observed, tick, settings_);
  }
}

bool SlamEstimator::carries_camera(std::size_t body) const {
  return std::any_of(cameras_.begin(), cameras_.end(),
                     [&](const FeatureTracker& camera) { return camera.camera().body == body; });
}

/// Finds the features in the images. Without a pose (`was_lost`) only enough matches count, since few may be false.
void SlamEstimator::match_images(Estimate& e, bool was_lost, StageClock& stage) {
  for (FeatureTracker& camera : cameras_) camera.predict(e, motion_of(camera));
  stage.mark("predict");
  for (FeatureTracker& camera : cameras_) camera.search();
  stage.mark("search");
  for (FeatureTracker& camera : cameras_) camera.add_plane_uncertainty();
  stage.mark("planes");
  int matched = 0, searched = 0;
  for (FeatureTracker& camera : cameras_) {
    camera.reject_outliers(e);
    matched += camera.matched();
    searched += camera.camera().settings.search.max_measurements;
  }
  stage.mark("consensus");
  if (!was_lost || matched >= std::min(settings_.health.min_matches_to_relocate, searched)) return;
  for (FeatureTracker& camera : cameras_) camera.discard_matches();
}

// ---- Correction

bool SlamEstimator::correct(Estimate& e) {
  measurements_.clear();
  for (const FeatureTracker& camera : cameras_) camera.append_measurements(e, measurements_);
  measurements_.insert(measurements_.end(), inliers_.measurements.begin(), inliers_.measurements.end());
  const auto relinearize = [&](const AnyBelief&) {
    std::vector<LinearizedMeasurement> again;
    for (FeatureTracker& camera : cameras_) camera.append_relinearized(e, motion_of(camera), again);
    append_relinearized(e, inliers_, settings_, again);
    return again;
  };
  const bool done = incognita::correct(e, measurements_, relinearize, settings_);
  for (FeatureTracker& camera : cameras_) {
    if (!done) camera.discard_matches();
    camera.after_correction(e, motion_of(camera));
    e.last.image_matches += camera.matched();
  }
  for (const std::size_t i : inliers_.indices) {
    Match& match = e.last.matches[i];
    match.outcome = done ? MatchOutcome::matched : MatchOutcome::outlier;
    if (done && !match.of_body) ++e.landmarks.at(match.id).detection_count;
  }
  e.last.matched = e.last.image_matches + (done ? static_cast<int>(inliers_.indices.size()) : 0);
  return done;
}

/// The map after the correction: new landmarks of the point sensors, conversions, frame and correlations.
void SlamEstimator::update_map(Estimate& e, StageClock& stage) {
  initialize_candidates(e, inliers_, settings_);
  convert_converged_inverse_depths(e, settings_);
  stage.mark("initialize");
  recenter_map(e);
  decorrelate(e, settings_.filter.decorrelate);
  stage.mark("decorrelate");
}

// ---- Health

void SlamEstimator::assess(Estimate& e) {
  for (FeatureTracker& camera : cameras_) {
    camera.count_frames_away();
    e.last.predicted += camera.camera().predicted;
  }
  e.status = incognita::assess(e, !cameras_.empty(), settings_);
  if (e.status.state == TrackingState::lost && !cameras_.empty()) search_around_last_pose(e);
}

/// From lost: the estimate is relocated once it was corrected by enough matches and is certain again.
void SlamEstimator::relocate(Estimate& e, bool corrected) {
  for (const FeatureTracker& camera : cameras_) e.last.predicted += camera.camera().predicted;
  if (!corrected || e.last.image_matches == 0) return;
  const bool certain = std::all_of(e.bodies.begin(), e.bodies.end(), [&](const Body& body) {
    return sigma_position(body) <= settings_.health.max_sigma_position_m;
  });
  if (certain) {
    e.status = {TrackingState::relocated, std::to_string(e.last.image_matches) + " features matched again"};
    e.health = {};
    return;
  }
  search_around_last_pose(e);
  for (FeatureTracker& camera : cameras_) camera.discard_matches();
  e.last.matched -= e.last.image_matches;
  e.last.image_matches = 0;
  e.last.update = {};
}

/// Puts the bodies with cameras at rest at their last poses.
void SlamEstimator::search_around_last_pose(Estimate& e) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i)
    if (carries_camera(i)) stop_and_search(e, i, settings_);
  for (FeatureTracker& camera : cameras_) camera.forget_depth_lines(e);
  update_poses(e);
}

// ---- Results

void SlamEstimator::report(Estimate& e) const {
  e.last.predicted += static_cast<int>(e.last.matches.size());
  for (const FeatureTracker& camera : cameras_) {
    e.last.visible += static_cast<int>(camera.camera().matches.size());
    camera.append_matches(e.last.matches);
  }
}

void SlamEstimator::refresh_entropy(Estimate& e, double t) const {
  const double period_s = entropy_period_s(e.belief.errors());
  if (!e.entropy_t || has_come(*e.entropy_t + period_s, t)) {
    e.entropy = entropies(e);
    e.entropy_t = t;
  } else {
    e.entropy.vehicle = vehicle_entropy(e);
  }
}

namespace {

/// State and covariance of a body in the world.
void express_in_world(const Estimate& e, Body& body) {
  if (!e.world) {
    body.state = e.belief.mean(body.block);
    body.state_covariance = e.belief.covariance(body.block);
    return;
  }
  const planar::FramedPose at = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)),
                                                 planar::Pose<double>(e.belief.mean(body.block)));
  const SmallMatrix cross = at.by_pose * e.belief.covariance(body.block, *e.world) * at.by_frame.transpose();
  body.state = at.pose;
  body.state_covariance = at.by_frame * e.belief.covariance(*e.world) * at.by_frame.transpose() +
                          at.by_pose * e.belief.covariance(body.block) * at.by_pose.transpose() + cross +
                          cross.transpose();
}

}  // namespace

void SlamEstimator::update_poses(Estimate& e) const {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    Body& body = e.bodies[i];
    express_in_world(e, body);
    const SmallMatrix J = pose_jacobian(settings_.bodies[i].motion, body.state);
    body.pose = pose_of(settings_.bodies[i].motion, body.state);
    body.pose_covariance = J * body.state_covariance * J.transpose();
  }
}

}  // namespace incognita
