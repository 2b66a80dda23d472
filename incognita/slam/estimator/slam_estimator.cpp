#include "incognita/slam/estimator/slam_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "incognita/slam/estimator/check_observation.hpp"
#include "incognita/slam/mapper/bodies.hpp"
#include "incognita/slam/mapper/correction.hpp"
#include "incognita/slam/mapper/drift.hpp"
#include "incognita/slam/mapper/health.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "incognita/slam/mapper/measurements.hpp"
#include "incognita/slam/mapper/prediction.hpp"
#include "incognita/slam/mapper/relative_sigma.hpp"
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
  const bool invariant = s.filter.linearization == Linearization::invariant;
  if (invariant != c.settings.filter.invariant)
    return "invariant errors must be asked for in the settings of the camera and of the filter, or in neither";
  if (invariant && c.settings.initialization.method == InitializationSettings::Method::depth_line)
    return "estimator.invariant is derived for inverse depths and points: take landmark_initialization.method = "
           "`inverse-depth`, or estimator.invariant = false";
  const bool lasts = c.settings.filter.sigma_lasting_px > 0;
  if (lasts && c.settings.initialization.method == InitializationSettings::Method::depth_line)
    return "depth hypotheses on a line take all errors of matches for white: take sensor.sigma_lasting_px = 0 and a "
           "sensor.sigma_pixel_px that covers them, e.g. 0.4, or landmark_initialization.method = `inverse-depth`";
  if (lasts && c.settings.filter.adapt_sigma_pixel)
    return "sensor.adapt_sigma_pixel follows all of the error of a match, also what sensor.sigma_lasting_px stands for: set one of "
           "them to false or 0";
  if (lasts && (s.filter.form != BeliefForm::covariance || s.filter.decorrelate != Decorrelation::nothing))
    return "lasting errors of matches are estimated in covariance form with all correlations only; take sensor.sigma_lasting_px = "
           "0 and a sensor.sigma_pixel_px that covers them, e.g. 0.4";
  return "";
}

/// One camera, which is the only body, and whose images are its only measurements, in covariance form. Keyframes are poses of that
/// body, and a drift moves it with all that was mapped.
bool is_one_free_camera(const EstimatorSettings& settings, const std::vector<FeatureTracker>& cameras) {
  if (cameras.size() != 1 || settings.bodies.size() != 1) return false;
  const BodyModel& body = settings.bodies[0];
  const TrackedCamera& camera = cameras[0].camera();
  return !camera.mount && !body.wheels && !(body.sigma_fix_m > 0) && body.sensors.empty() &&
         camera.settings.initialization.method != InitializationSettings::Method::depth_line &&
         settings.filter.form == BeliefForm::covariance;
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
  const bool is_alone = is_one_free_camera(settings_, cameras_);
  for (FeatureTracker& camera : cameras_) {
    if (!is_alone) camera.adjust_no_bundle();
    if (!is_alone || settings_.filter.decorrelate != Decorrelation::nothing) camera.close_no_loops();
  }
  frame_counters_.resize(cameras_.size());
  bodies_.resize(settings_.bodies.size());
}

void SlamEstimator::update(Estimate& e, const Command& command, const Observation& observation,
                           const Tick& tick) {
  check_observation(observation, settings_);
  StageClock stage(e.timing_ms);
  see(observation);
  stage.mark("sums");
  e.last.restart();
  if (!e.first_t) e.first_t = tick.t;
  count_frames(tick);
  const bool starts = !e.started;
  if (starts) {
    start_.start(e, cameras_, settings_, observation, tick);
    for (TrackedBody& body : bodies_) body.matched_few = false;
  }
  stage.mark("start");
  if (!e.started) return;
  if (starts) begin_errors(e);
  const bool tracks = !cameras_.empty() && !starts;
  note_lost(e);
  predict(e, command, observation, tick);
  stage.mark("predict");
  if (tracks) match_images(e, stage);
  associate_detections(e, observation, settings_, inliers_);
  stage.mark("associate");
  const bool corrected = correct(e);
  stage.mark("update");
  update_map(e, stage);
  express_in_world(e, settings_);
  if (tracks || cameras_.empty()) assess(e, corrected);
  stage.mark("poses");
  if (tracks) maintain_maps(e);
  begin_errors(e);
  report(e);
  stage.mark("map");
  if (settings_.filter.entropy) entropy_.update(e, tick.t);
  stage.mark("entropy");
}

/// Of the landmarks that were added since.
void SlamEstimator::begin_errors(Estimate& e) const {
  if (settings_.filter.linearization == Linearization::invariant) begin_invariant_errors(e);
}

void SlamEstimator::see(const Observation& observation) {
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const std::size_t body = cameras_[k].camera().body;
    const auto before = std::count_if(cameras_.begin(), cameras_.begin() + static_cast<std::ptrdiff_t>(k),
                                      [&](const FeatureTracker& c) { return c.camera().body == body; });
    cameras_[k].see(image_of(body_of(observation, body), static_cast<std::size_t>(before)).get());
  }
}

/// Frames that all cameras of a body have missed; nothing if none of them ever had an image.
std::optional<int> SlamEstimator::missed_frames(std::size_t body) const {
  std::optional<int> least;
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const std::optional<int> missed = frame_counters_[k].missed();
    if (cameras_[k].camera().body == body && missed) least = std::min(least.value_or(*missed), *missed);
  }
  return least;
}

/// Frames of each body at this tick; none without cameras.
void SlamEstimator::count_frames(const Tick& tick) {
  for (TrackedBody& body : bodies_) body.frames = 0;
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    frame_counters_[k].update(cameras_[k].has_image(), tick.t);
    if (cameras_[k].has_image()) bodies_[cameras_[k].camera().body].frames = 1;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!carries_camera(i)) continue;
    const int missed = missed_frames(i).value_or(bodies_[i].missed + 1);
    if (bodies_[i].frames == 0) bodies_[i].frames = missed - bodies_[i].missed;
    bodies_[i].missed = missed;
  }
}

/// Bodies with cameras that are lost stay so until they are relocated.
void SlamEstimator::note_lost(const Estimate& e) {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies_[i].was_lost = carries_camera(i) && e.bodies[i].status.state == TrackingState::lost;
}

bool SlamEstimator::carries_camera(std::size_t body) const {
  return std::ranges::any_of(cameras_,
                             [&](const FeatureTracker& camera) { return camera.camera().body == body; });
}

// ---- Prediction and matching

namespace {

/// The mean of the readings of a tick.
std::optional<Eigen::Vector2d> mean_input(const std::vector<Odometry>& readings) {
  if (readings.empty()) return std::nullopt;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Odometry& reading : readings) sum += reading.input;
  return sum / static_cast<double>(readings.size());
}

/// The commanded input of a body; zero without one, and for a camera whose carrier is commanded.
SmallVector commanded_input(const Command& command, std::size_t body, const AnyMotion& motion) {
  const SmallVector& input = command_of(command, body).input;
  return input.size() == inputs_of(motion) ? input : SmallVector(SmallVector::Zero(inputs_of(motion)));
}

}  // namespace

/// Bodies that only have cameras stay where they were lost.
void SlamEstimator::predict(Estimate& e, const Command& command, const Observation& observation,
                            const Tick& tick) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    const BodyObservation& observed = body_of(observation, i);
    const BodyModel& model = settings_.bodies[i];
    e.bodies[i].wheels.reset();
    if (traits_of(model.motion).in_space()) e.bodies[i].wheels = mean_input(observed.odometry);
    e.bodies[i].waits = bodies_[i].was_lost && model.sensors.empty();
    if (e.bodies[i].waits)
      e.bodies[i].t = tick.t;
    else
      predict_body(e, i, commanded_input(command, i, model.motion), observed, tick, settings_);
  }
  for (const FeatureTracker& camera : cameras_) camera.predict_lasting_errors(e, tick.dt);
}

void SlamEstimator::predict_features(Estimate& e, FeatureTracker& camera) {
  if (bodies_[camera.camera().body].was_lost)
    camera.forget_lasting_errors();
  else
    camera.align(e, motion_of(camera));
  camera.predict(e, motion_of(camera));
}

/// Finds the features in the image. Of a lost body only enough matches count, since few may be false.
void SlamEstimator::search_features(const Estimate& e, FeatureTracker& camera, StageClock& stage) {
  camera.search();
  stage.mark("search");
  camera.add_plane_uncertainty();
  stage.mark("planes");
  camera.reject_outliers(e);
  const int enough = std::min(settings_.health.min_matches_to_relocate, camera.camera().most_measurements());
  if (bodies_[camera.camera().body].was_lost && camera.matched() < enough) camera.discard_matches();
  stage.mark("consensus");
}

/// Whether this camera alone tells how its body moved, and the body is free to do so.
bool SlamEstimator::may_jump(const Estimate& e, const FeatureTracker& camera) const {
  const std::size_t body = camera.camera().body;
  const auto cameras =
      std::ranges::count_if(cameras_, [&](const FeatureTracker& c) { return c.camera().body == body; });
  return cameras == 1 && !camera.camera().mount && !bodies_[body].was_lost &&
         e.bodies[body].t > camera.last_image_t();
}

/// Searches again, after a motion that the motion model did not expect. All is as before if fewer features are found than
/// `least`.
void SlamEstimator::search_after_jump(Estimate& e, FeatureTracker& camera, const Jump& jump, int least,
                                      StageClock& stage) {
  const std::size_t body = camera.camera().body;
  AnyBelief::BeforeNoise belief_before = e.belief.before_noise(e.bodies[body].block);
  TrackedCamera camera_before = camera.camera();
  add_jump(e, body, jump, e.bodies[body].t - camera.last_image_t());
  predict_features(e, camera);
  stage.mark("predict");
  search_features(e, camera, stage);
  if (camera.matched() >= least) return;
  e.belief.take_noise_back(std::move(belief_before));
  camera.restore(std::move(camera_before));
}

/// The whole image turned by more than the motion model allows. Its alignment may be wrong, by a shadow for example: searches
/// without it and then with it, and leaves it out if more features, and enough to track, are found without.
void SlamEstimator::search_after_turn(Estimate& e, FeatureTracker& camera, const Eigen::Vector3d& turn,
                                      StageClock& stage) {
  constexpr double translation_share = 0.5;  // of the image motion, in standard deviations of the turn
  camera.forget_alignment();
  search_features(e, camera, stage);
  const bool enough = !found_few(camera);
  const double rad = turn.norm();
  const Jump jump{turn, translation_share * rad * camera.camera().median_depth_m, rad};
  search_after_jump(e, camera, jump, enough ? camera.matched() : 0, stage);
}

/// A jolt moves a camera by more than its motion model allows, and the alignment of the image shows the turn only.
void SlamEstimator::search_after_jolt(Estimate& e, FeatureTracker& camera, StageClock& stage) {
  constexpr double sigma_depths = 0.02, sigma_rad = 0.01, least_share = 0.5;
  const TrackedCamera& seen = camera.camera();
  const Jump jump{Eigen::Vector3d::Zero(), sigma_depths * seen.median_depth_m, sigma_rad};
  search_after_jump(e, camera, jump, static_cast<int>(std::ceil(least_share * seen.predicted)), stage);
}

bool SlamEstimator::found_few(const FeatureTracker& camera) const {
  return camera.matched() < least_found(camera.camera().predicted, bodies_[camera.camera().body].matched_few);
}

/// Finds the features of one camera, as its motion model expects them or else as after a jump.
void SlamEstimator::match_image(Estimate& e, FeatureTracker& camera, StageClock& stage) {
  predict_features(e, camera);
  stage.mark("predict");
  const bool may_jump = this->may_jump(e, camera);
  const std::optional<Eigen::Vector3d> turn = may_jump ? camera.unexpected_turn() : std::nullopt;
  if (turn)
    search_after_turn(e, camera, *turn, stage);
  else
    search_features(e, camera, stage);
  if (may_jump && found_few(camera)) search_after_jolt(e, camera, stage);
}

/// Corrects a drift that returning landmarks show, if they then match jointly with those that are tracked.
void SlamEstimator::close_loop(Estimate& e, FeatureTracker& camera, StageClock& stage) {
  if (!may_jump(e, camera)) return camera.forget_loop();
  const std::optional<ClosedLoop> loop = camera.find_loop(e, e.body().t);
  stage.mark("relocalize");
  if (!loop) return;
  Estimate before = e;
  TrackedCamera camera_before = camera.camera();
  correct_drift(e, 0, loop->correction, loop->landmarks);
  camera.move_views(*loop);
  camera.predict(
      e, motion_of(camera));  // the alignment of the image stays: camera and landmarks in view moved together
  stage.mark("predict");
  search_features(e, camera, stage);
  e.last.loop_closed = camera.confirms(*loop, camera_before) && !found_few(camera);
  if (e.last.loop_closed) {
    camera.restart_keyframes();
    return;
  }
  before.timing_ms = e.timing_ms;
  e = std::move(before);
  camera.restore(std::move(camera_before));
}

void SlamEstimator::match_images(Estimate& e, StageClock& stage) {
  for (FeatureTracker& camera : cameras_) match_image(e, camera, stage);
  for (FeatureTracker& camera : cameras_)
    if (camera.camera().settings.relocalization.close_loops) close_loop(e, camera, stage);
  discard_few_matches();
  for (FeatureTracker& camera : cameras_)
    if (bodies_[camera.camera().body].was_lost && searches_whole_map(camera)) find_in_map(e, camera);
  stage.mark("relocalize");
}

/// Of features searched for, the number of matches below which these may be false. One frame may match few, for example after a
/// jolt; in the next ones right matches become more than chance gives, and false ones do not.
double SlamEstimator::least_found(int searched, bool after_few) const {
  constexpr double more_after_few = 1.6;  // times the least share; of a large one half of the rest more
  const double least = settings_.health.min_matched_share * searched;
  return after_few ? std::min(more_after_few * least, (least + searched) / 2) : least;
}

/// Discards the matches of bodies of whose features too few were found.
void SlamEstimator::discard_few_matches() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    int searched = 0, matched = 0;
    for (const FeatureTracker& camera : cameras_) {
      if (camera.camera().body != i) continue;
      searched += camera.camera().predicted;
      matched += camera.matched();
    }
    if (bodies_[i].was_lost) bodies_[i].matched_few = false;
    if (bodies_[i].was_lost || searched == 0) continue;
    const double least = least_found(searched, bodies_[i].matched_few);
    bodies_[i].matched_few = matched < least_found(searched, true);
    if (matched >= least) continue;
    for (FeatureTracker& camera : cameras_)
      if (camera.camera().body == i) camera.discard_matches();
  }
}

/// Only the pose of a camera that is the body itself can be replaced.
bool SlamEstimator::searches_whole_map(const FeatureTracker& camera) const {
  return camera.camera().settings.relocalization.whole_map && !camera.camera().mount &&
         settings_.filter.form == BeliefForm::covariance;
}

/// A lost camera is taken to the pose that the search around its last pose gives or, failing that, the search of the whole
/// map. Either needs evidence; without, the belief stays as it was.
void SlamEstimator::find_in_map(Estimate& e, FeatureTracker& camera) {
  const std::size_t which = camera.camera().body;
  std::optional<PoseEvidence> found = camera.find_in_map(e, e.bodies[which].t);
  camera.discard_matches();
  if (!found) return;
  const Estimate before = e;
  // The same matches correct the filter: a prior this wide adds 1 % to their information
  constexpr double prior_sigmas = 10;
  SmallMatrix P = SmallMatrix::Zero(FreeCameraMotion::error_size, FreeCameraMotion::error_size);
  P.topLeftCorner<6, 6>() = prior_sigmas * prior_sigmas * found->cov;
  P.diagonal().segment<3>(6).setConstant(std::pow(settings_.health.sigma_search_velocity_m_s, 2));
  P.diagonal().tail<3>().setConstant(std::pow(settings_.health.sigma_search_rate_rad_s, 2));
  put_body(e, which, found->camera, P);
  restart_invariant_errors(e);
  camera.take_matches(*std::move(found), e);
  if (camera.matched() >= camera.camera().settings.relocalization.min_matches) return;
  camera.discard_matches();
  e = before;
}

// ---- Correction

namespace {

/// Counts matches that corrected the filter.
void count_matches(Estimate& e, std::size_t body, int matches, bool in_images) {
  e.bodies[body].counts.matched += matches;
  e.last.matched += matches;
  if (!in_images) return;
  e.bodies[body].counts.image_matches += matches;
  e.last.image_matches += matches;
}

}  // namespace

bool SlamEstimator::correct(Estimate& e) {
  measurements_.clear();
  for (FeatureTracker& camera : cameras_) {
    camera.lend_lasting_errors(e);
    camera.append_measurements(e, measurements_);
  }
  measurements_.insert(measurements_.end(), inliers_.measurements.begin(), inliers_.measurements.end());
  const auto relinearize = [&](const AnyBelief&) {
    std::vector<LinearizedMeasurement> again;
    for (FeatureTracker& camera : cameras_) camera.append_relinearized(e, motion_of(camera), again);
    append_relinearized(e, inliers_, settings_, again);
    return again;
  };
  const bool done = incognita::correct(e, measurements_, relinearize, settings_);
  for (Body& body : e.bodies) body.counts = {};
  for (FeatureTracker& camera : cameras_) {
    if (!done) camera.discard_matches();
    camera.after_correction(e, motion_of(camera));
    count_matches(e, camera.camera().body, camera.matched(), true);
    if (const auto readout = camera.readout()) e.bodies[camera.camera().body].health.readout = readout;
  }
  for (const std::size_t i : inliers_.indices) {
    Match& match = e.last.matches[i];
    match.outcome = done ? MatchOutcome::matched : MatchOutcome::outlier;
    if (!done) continue;
    if (!match.of_body) ++e.landmarks.at(match.id).detection_count;
    count_matches(e, static_cast<std::size_t>(match.body), 1, false);
  }
  return done;
}

/// The map after the correction: new landmarks of the point sensors, conversions, frame and correlations.
void SlamEstimator::update_map(Estimate& e, StageClock& stage) {
  pruning_.update(e, settings_);
  depth_lines_.follow(e, inliers_.candidates, settings_);
  initialize_candidates(e, inliers_, settings_);
  depth_lines_.take_up(e, settings_);
  convert_converged_inverse_depths(e, settings_);
  stage.mark("initialize");
  recenter_map(e);
  decorrelate(e, settings_.filter.decorrelate);
  stage.mark("decorrelate");
}

// ---- Health

/// The status of each body and, from them, that of the estimate.
void SlamEstimator::assess(Estimate& e, bool corrected) {
  for (FeatureTracker& camera : cameras_) {
    const std::size_t body = camera.camera().body;
    if (!camera.has_image() && !bodies_[body].was_lost) continue;
    if (!bodies_[body].was_lost) camera.count_frames();
    e.last.predicted += camera.camera().predicted;
    e.bodies[body].counts.searched += camera.camera().predicted;
  }
  in_images_.restart();
  for (const FeatureTracker& camera : cameras_) camera.append_matches(in_images_);
  note_matched(e, in_images_.matches, settings_);
  if (std::ranges::any_of(bodies_, [](const TrackedBody& body) { return !body.was_lost; }))
    count_doubted(e, settings_.health);
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    if (bodies_[i].was_lost) {
      if (corrected) relocate(e, i);
      continue;
    }
    e.bodies[i].status = incognita::assess(e, i, bodies_[i].frames, settings_);
    if (carries_camera(i) && e.bodies[i].status.state == TrackingState::lost) search_around_last_pose(e, i);
    if (e.last.loop_closed && e.bodies[i].status.state == TrackingState::tracking)
      e.bodies[i].status = {TrackingState::relocated,
                            "a loop was closed: landmarks returned beside where they were expected"};
  }
  e.status = worst_of(e.bodies);
}

/// From lost: a body is relocated once it was corrected by enough matches of its cameras, or by another sensor that it
/// carries, and is certain again.
void SlamEstimator::relocate(Estimate& e, std::size_t which) {
  Body& body = e.bodies[which];
  if (body.counts.matched == 0) return;
  if (is_certain(e, which, settings_)) {
    body.status = {TrackingState::relocated,
                   std::to_string(body.counts.matched) + " measurements match again"};
    body.health = {};
    if (std::ranges::all_of(bodies_, &TrackedBody::was_lost))
      e.health = {};  // else it is about the others, too
    return;
  }
  search_around_last_pose(e, which);
  for (FeatureTracker& camera : cameras_)
    if (camera.camera().body == which) camera.discard_matches();
  count_matches(e, which, -body.counts.image_matches, true);
  if (e.last.matched == 0) e.last.update = {};
}

/// Puts a body with cameras at rest at its last pose.
void SlamEstimator::search_around_last_pose(Estimate& e, std::size_t which) {
  stop_and_search(e, which, settings_);
  for (FeatureTracker& camera : cameras_)
    if (camera.camera().body == which) camera.forget_depth_lines(e);
  express_in_world(e, settings_);
}

/// Maps of the cameras of bodies that are tracked: those without one start it with their first image, the others need
/// enough matches.
void SlamEstimator::maintain_maps(Estimate& e) {
  for (FeatureTracker& camera : cameras_) {
    const std::size_t which = camera.camera().body;
    const Body& body = e.bodies[which];
    if (bodies_[which].was_lost || body.status.state == TrackingState::lost) continue;
    if (!camera.has_map() && camera.has_image())
      camera.start_map(e, {}, motion_of(camera));
    else if (body.health.frames_with_few == 0)
      camera.maintain_map(e, motion_of(camera));
    if (camera.moved_estimate()) express_in_world(e, settings_);
  }
}

void SlamEstimator::forget_poses(Estimate& e, const std::string& reason) {
  if (!e.started)
    throw std::invalid_argument("the run was saved before its estimate started: there is no map");
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto recognizes = [&](const FeatureTracker& c) {
      return c.camera().body == i && searches_whole_map(c);
    };
    if (!settings_.bodies[i].sensors.empty() || std::ranges::none_of(cameras_, recognizes))
      throw std::invalid_argument(
          "body " + std::to_string(i + 1) +
          " cannot find itself in a map: that needs a camera that moves freely, relocalization.whole_map = true and "
          "a belief in covariance form");
  }
  e.first_t.reset();
  e.health = {};
  e.entropy = {};
  e.entropy_t.reset();
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    stop_and_search(e, i, settings_);
    e.bodies[i].health = {};
    e.bodies[i].first_fix_t.reset();
    e.bodies[i].status = {TrackingState::lost, reason};
  }
  express_in_world(e, settings_);
  e.status = worst_of(e.bodies);
  for (FeatureTracker& camera : cameras_) {
    camera.forget_depth_lines(e);
    camera.forget_time();
  }
  frame_counters_.assign(cameras_.size(), {});
  bodies_.assign(bodies_.size(), {});
  entropy_ = {};
}

// ---- Results

void SlamEstimator::report(Estimate& e) const {
  e.last.predicted += static_cast<int>(e.last.matches.size());
  for (const FeatureTracker& camera : cameras_) camera.append_matches(e.last);
}

}  // namespace incognita
