#include "incognita/slam/estimator/slam_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

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
  if (c.mount && camera.has_target())
    return "a camera on a mount does not start from a target, which gives the pose of the camera and not of its vehicle: "
           "start from the pose of the vehicle";
  if (s.filter.map_frame == MapFrame::vehicle)
    return "estimator.map_frame = `vehicle`: images are tracked in a map in the world frame; take `world`";
  if (s.filter.linearization == Linearization::first_estimate)
    return "first-estimate Jacobians are derived for ranges and bearings on a plane only, not for images; take `analytic`";
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

void check_detections(const BodyObservation& observed, std::size_t body, const EstimatorSettings& s) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("a detection of body " + std::to_string(body + 1) + why);
  };
  const auto check_sensor = [&](const PointDetection& d) {
    const std::size_t sensors = s.bodies[body].sensors.size();
    if (d.sensor < 0 || static_cast<std::size_t>(d.sensor) >= sensors)
      refuse(" is of its point sensor " + std::to_string(d.sensor + 1) + ", but it has " +
             std::to_string(sensors));
  };
  const bool by_identity = s.association.method == DataAssociationSettings::Method::known;
  for (const PointDetection& d : observed.landmarks) {
    check_sensor(d);
    if (by_identity && d.identity >= first_feature_number)
      refuse(" has the identity " + std::to_string(d.identity) + "; identities must be below " +
             std::to_string(first_feature_number));
  }
  for (const PointDetection& d : observed.vehicles) {
    check_sensor(d);
    if (d.identity < 0 || static_cast<std::size_t>(d.identity) >= s.bodies.size())
      refuse(" is of body " + std::to_string(d.identity + 1) + ", but there are " +
             std::to_string(s.bodies.size()));
  }
}

/// Before anything changes: an observation that is refused leaves the estimate as it was.
void check(const Observation& observation, const EstimatorSettings& s) {
  if (observation.bodies.empty()) return;
  if (observation.bodies.size() != s.bodies.size())
    throw std::invalid_argument("observations of " + std::to_string(observation.bodies.size()) +
                                " vehicles were given to an estimator of " + std::to_string(s.bodies.size()));
  for (std::size_t i = 0; i < s.bodies.size(); ++i) check_detections(observation.bodies[i], i, s);
}

}  // namespace

void SlamEstimator::update(Estimate& e, const Command& command, const Observation& observation,
                           const Tick& tick) {
  check(observation, settings_);
  StageClock stage(e.timing_ms);
  see(observation);
  stage.mark("sums");
  e.last.restart();
  if (!e.first_t) e.first_t = tick.t;
  const int frames = count_frames(tick);
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
    assess(e, frames);
  stage.mark("poses");
  if (tracks && !was_lost && e.status.state != TrackingState::lost) maintain_maps(e);
  report(e);
  stage.mark("map");
  refresh_entropy(e, tick.t);
  stage.mark("entropy");
}

/// Maps of the cameras: those without one start it with their first image, the others need enough matches.
void SlamEstimator::maintain_maps(Estimate& e) {
  for (FeatureTracker& camera : cameras_) {
    if (!camera.has_map() && camera.has_image())
      camera.start_map(e, {}, motion_of(camera));
    else if (e.health.frames_with_few == 0)
      camera.maintain_map(e);
  }
}

void SlamEstimator::see(const Observation& observation) {
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const std::size_t body = cameras_[k].camera().body;
    const auto before = std::count_if(cameras_.begin(), cameras_.begin() + static_cast<std::ptrdiff_t>(k),
                                      [&](const FeatureTracker& c) { return c.camera().body == body; });
    cameras_[k].see(image_of(body_of(observation, body), static_cast<std::size_t>(before)).get());
  }
}

/// Frames of the cameras at this tick: 1 with an image. Ticks may be more frequent than images; without one, the frames
/// that are overdue by the period of the last images, as of a camera that failed.
int SlamEstimator::count_frames(const Tick& tick) {
  if (cameras_.empty()) return 0;
  if (std::ranges::any_of(cameras_, &FeatureTracker::has_image)) {
    if (image_t_ && missed_frames_ == 0) image_period_s_ = tick.t - *image_t_;
    image_t_ = tick.t;
    missed_frames_ = 0;
    return 1;
  }
  if (!image_t_ || !(image_period_s_ > 0)) return 1;
  const int missed = static_cast<int>(std::min(1e6, (tick.t - *image_t_) / image_period_s_ + 1e-6));
  return missed - std::exchange(missed_frames_, missed);
}

// ---- Start

namespace {

double start_time(const BodyModel& model, const BodyObservation& observed,
                  const std::optional<PositionReading>& fix, double t) {
  if (model.start_time == BodyModel::StartTime::first_fix) return fix->t;
  if (model.start_time == BodyModel::StartTime::first_reading && !observed.odometry.empty())
    return std::min(t, observed.odometry.front().t);
  return t;
}

/// The mean of the readings of a tick.
std::optional<Eigen::Vector2d> mean_input(const std::vector<Odometry>& readings) {
  if (readings.empty()) return std::nullopt;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Odometry& reading : readings) sum += reading.input;
  return sum / static_cast<double>(readings.size());
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

bool SlamEstimator::has_target(std::size_t body) const {
  return std::ranges::any_of(cameras_, [&](const FeatureTracker& camera) {
    return camera.camera().body == body && camera.has_target();
  });
}

/// Whether each body that has to wait for a position fix has one, now or from an earlier tick.
bool SlamEstimator::has_first_fixes(const Observation& observation) {
  first_fixes_.resize(settings_.bodies.size());
  bool all = true;
  for (std::size_t i = 0; i < settings_.bodies.size(); ++i) {
    if (settings_.bodies[i].start_time != BodyModel::StartTime::first_fix) continue;
    if (const auto& fixes = body_of(observation, i).fixes; !fixes.empty()) first_fixes_[i] = fixes.front();
    all = all && first_fixes_[i];
  }
  return all;
}

/// Whether each body with cameras can start: one of its cameras finds the target in its image or, if none of them has a
/// target, has had an image, now or at an earlier tick.
bool SlamEstimator::has_camera_starts(Estimate& e, double waited_s) {
  starts_.resize(cameras_.size());
  std::vector<bool> ready(settings_.bodies.size(), false);
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const FeatureTracker& camera = cameras_[k];
    const std::size_t body = camera.camera().body;
    FeatureTracker::Start start = camera.find_start(waited_s);
    if (camera.has_target() || start.ready || !starts_[k].ready) starts_[k] = std::move(start);
    if (starts_[k].ready && (camera.has_target() || !has_target(body))) ready[body] = true;
  }
  bool all = true;
  for (std::size_t k = 0; all && k < cameras_.size(); ++k) {
    all = ready[cameras_[k].camera().body];
    if (starts_[k].given_up && !all) e.status.state = TrackingState::lost;
    if (!all || starts_[k].pose || k == 0) e.status.reason = starts_[k].reason;
  }
  return all;
}

/// Starts all bodies at the same tick, since landmarks follow the bodies in the belief.
void SlamEstimator::start(Estimate& e, const Observation& observation, const Tick& tick) {
  e.status.state = TrackingState::starting;
  if (!has_first_fixes(observation)) {
    e.status.reason = "waiting for the first position fix";
    return;
  }
  if (!has_camera_starts(e, tick.t - *e.first_t)) return;
  const bool traced = e.belief.keeps_trace();
  e.belief = empty_belief(settings_.filter);
  e.bodies.clear();
  e.landmarks.clear();
  e.world.reset();
  e.health = {};
  e.belief.keep_trace(traced);
  add_anchors(e, settings_.anchors);
  if (!cameras_.empty() && settings_.association.method == DataAssociationSettings::Method::known)
    if (std::ranges::any_of(settings_.bodies, [](const BodyModel& body) { return !body.sensors.empty(); }))
      e.next_id = first_feature_number;
  add_bodies(e, observation, tick);
  e.started = true;
  e.status.state = TrackingState::tracking;
  if (cameras_.empty()) e.status.reason.clear();
  for (std::size_t k = 0; k < cameras_.size(); ++k)
    if (cameras_[k].has_image()) cameras_[k].start_map(e, starts_[k].pose, motion_of(cameras_[k]));
}

void SlamEstimator::add_bodies(Estimate& e, const Observation& observation, const Tick& tick) const {
  for (std::size_t i = 0; i < settings_.bodies.size(); ++i) {
    const BodyModel& model = settings_.bodies[i];
    SmallVector at = model.start;
    SmallMatrix P = model.start_sigmas.cwiseAbs2().asDiagonal();
    if (model.start_time == BodyModel::StartTime::first_fix) at.head<2>() = first_fixes_[i]->position;
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      if (cameras_[k].camera().body != i || !starts_[k].pose) continue;
      at.head<3>() = starts_[k].pose->position;
      at.segment<4>(3) = starts_[k].pose->world_from_camera;
      P.topLeftCorner<6, 6>() = starts_[k].pose->covariance;
    }
    add_body(e, model, at, P, start_time(model, body_of(observation, i), first_fixes_[i], tick.t),
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

/// `waits_in_place`: bodies that only have cameras stay where they were lost.
void SlamEstimator::predict(Estimate& e, const Command& command, const Observation& observation,
                            const Tick& tick, bool waits_in_place) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    const BodyObservation& observed = body_of(observation, i);
    const BodyModel& model = settings_.bodies[i];
    e.bodies[i].wheels.reset();
    if (traits_of(model.motion).in_space()) e.bodies[i].wheels = mean_input(observed.odometry);
    if (waits_in_place && carries_camera(i) && model.sensors.empty())
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
  for (FeatureTracker& camera : cameras_) {
    camera.reject_outliers(e);
    const int enough =
        std::min(settings_.health.min_matches_to_relocate, camera.camera().settings.search.max_measurements);
    if (was_lost && camera.matched() < enough) camera.discard_matches();
  }
  stage.mark("consensus");
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

/// `frames`: of this tick, see count_frames().
void SlamEstimator::assess(Estimate& e, int frames) {
  for (FeatureTracker& camera : cameras_) {
    if (!camera.has_image()) continue;
    camera.count_frames_away();
    e.last.predicted += camera.camera().predicted;
  }
  e.status = incognita::assess(e, frames, settings_);
  if (e.status.state == TrackingState::lost && !cameras_.empty()) search_around_last_pose(e);
}

/// From lost: the estimate is relocated once it was corrected by enough matches and is certain again. A body with a
/// camera and another sensor may also be relocated by that sensor.
void SlamEstimator::relocate(Estimate& e, bool corrected) {
  for (const FeatureTracker& camera : cameras_) e.last.predicted += camera.camera().predicted;
  const bool recognized =
      e.last.image_matches > 0 || std::ranges::any_of(inliers_.indices, [&](std::size_t i) {
        return carries_camera(static_cast<std::size_t>(e.last.matches[i].body));
      });
  if (!corrected || !recognized) return;
  const bool certain = std::all_of(e.bodies.begin(), e.bodies.end(), [&](const Body& body) {
    return sigma_position(body) <= settings_.health.max_sigma_position_m;
  });
  if (certain) {
    e.status = {TrackingState::relocated, std::to_string(e.last.matched) + " features matched again"};
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
