#include "incognita/slam/features/feature_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "incognita/math/median.hpp"
#include "incognita/slam/features/active_search.hpp"
#include "incognita/slam/features/automatic_settings.hpp"
#include "incognita/slam/features/depth_line.hpp"
#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/estimate_patch_planes.hpp"
#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/features/recognition.hpp"
#include "incognita/slam/features/renew_map.hpp"
#include "incognita/slam/features/search_feature.hpp"
#include "incognita/slam/features/validation.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"

namespace incognita {
namespace {

/// Of the points, by the filter since the last adjustment. If landmarks return, it closed a loop, and what the keyframes know is
/// of before. Otherwise the filter drifted along directions that are not observable, and the keyframes are right.
constexpr double most_moved_px = 10;
constexpr int least_returning = 5;
/// Of the pixel noise: what makes a keyframe is motion.
constexpr double least_motion_sigmas = 3;

void check_size(const Image& image, const Camera& camera) {
  if (image.width() != camera.width() || image.height() != camera.height())
    throw std::invalid_argument("image is " + std::to_string(image.width()) + "x" +
                                std::to_string(image.height()) + ", the camera is calibrated for " +
                                std::to_string(camera.width()) + "x" + std::to_string(camera.height()));
}

std::string found_in_words(const Target& target, const TargetPose& pose) {
  return "target " + target.name + " found, " + std::to_string(pose.rms_px) + " px rms";
}

}  // namespace

FeatureTracker::FeatureTracker(Camera camera, const CameraSlamSettings& settings,
                               const CameraPlacement& placement, std::uint64_t seed)
    : camera_{.camera = camera,
              .settings = with_automatic(settings, camera),
              .body = placement.body,
              .mount = placement.mount,
              .median_depth_m = 1 / settings.initialization.inverse_depth_per_m},
      placement_(placement),
      relocalization_(seed),
      loop_closure_(seed),
      random_(seed, "slam.birth") {
  validate(settings, placement.target, placement.max_search_s);
}

void FeatureTracker::set_index(int index) { camera_.index = index; }

void FeatureTracker::adjust_no_bundle() { camera_.settings.bundle.adjust = false; }

void FeatureTracker::close_no_loops() { camera_.settings.relocalization.close_loops = false; }

void FeatureTracker::see(const Image* image) {
  sees_ = image && !image->empty();
  if (!sees_) return;
  check_size(*image, camera_.camera);
  pyramid_.assign(*image, camera_.settings.search.levels);
  camera_.guide.reset();
  if (!camera_.settings.search.align_images) return;
  std::swap(small_, small_before_);
  small_.assign(*image);
}

FeatureTracker::Start FeatureTracker::find_start(double waited_s) const {
  Start start;
  start.reason = "no image yet";
  if (sees_ && !placement_.target)
    return {true, false, {}, "started without a target: the scale is not observable"};
  if (sees_) {
    TargetSearch search =
        find_target(*placement_.target, camera_.camera, pyramid_.summed(), std::sqrt(camera_.error_var()));
    if (search.pose) {
      std::string reason = found_in_words(*placement_.target, *search.pose);
      return {true, false, std::move(search.pose), std::move(reason)};
    }
    start.reason = search.reason;
  }
  start.given_up = placement_.target && waited_s > placement_.max_search_s;
  return start;
}

void FeatureTracker::start_map(Estimate& estimate, const std::optional<TargetPose>& pose,
                               const AnyMotion& motion) {
  has_map_ = true;
  camera_.features.clear();
  camera_.view = viewpoint(estimate, camera_, motion);
  before_ = camera_.view.camera;
  before_t_ = estimate.bodies[camera_.body].t;
  for (std::size_t i = 0; pose && i < placement_.target->corners.size(); ++i) {
    auto view = cut_view(pyramid_, pose->pixels[i], camera_.view.camera, camera_.camera, camera_.settings);
    if (!view) continue;
    view->plane.facing = placement_.target->normal;
    view->plane.slope_cov.setZero();
    add_anchor(placement_.target->corners[i].position, *std::move(view), estimate, camera_);
  }
  if (pose) correct_by_target(estimate);
  expect_depth_of_target(estimate);
  // The first map is initialized at once: without a target there is nothing else to track
  for (;;) {
    const std::size_t before = camera_.features.size();
    predict_matches(estimate, camera_);
    add_landmarks(estimate);
    if (camera_.features.size() == before) break;
  }
  if (!camera_.settings.bundle.adjust) return;
  keyframes_.start(camera_.view.camera, pose_cov(estimate), estimate.bodies[camera_.body].t);
  add_new_landmarks_to_keyframe(std::numeric_limits<std::int64_t>::min());
}

/// A target that is nearer than the prior of the depth admits hangs on something that is near too, a wall or a table: the prior of the
/// first landmarks is then scaled to it, as later to the landmarks in view.
void FeatureTracker::expect_depth_of_target(const Estimate& estimate) {
  constexpr double admitted_sigmas = 2;
  const InitializationSettings& s = camera_.settings.initialization;
  const Eigen::Vector3d from = free_camera::position(camera_.view.camera);
  std::vector<double> distances;
  for (const auto& [id, feature] : camera_.features)
    distances.push_back((estimate.landmarks.at(id).position - from).norm());
  if (distances.empty()) return;
  const double distance_m = median(distances);
  if (1 / distance_m > s.inverse_depth_per_m + admitted_sigmas * s.sigma_inverse_depth_per_m)
    camera_.median_depth_m = distance_m;
}

Eigen::Matrix<double, 6, 6> FeatureTracker::start_cov(const TargetPose& pose) const {
  constexpr double prior_sigmas = 10;  // adds 1 % to the information of the corners
  return camera_.settings.filter.sigma_lasting_px > 0 ? prior_sigmas * prior_sigmas * pose.covariance
                                                      : pose.covariance;
}

/// The pose was solved from corners of the image where the patches of the anchors were then cut: as long as these are matched, the
/// errors of the corners last. The corners correct a wide prior, so that the filter knows how they depend on each other.
void FeatureTracker::correct_by_target(Estimate& estimate) {
  if (!(camera_.settings.filter.sigma_lasting_px > 0)) return;
  std::vector<FeatureMatch> corners;
  for (const auto& [id, feature] : camera_.features) {
    auto match = predict_pixel(estimate.landmarks.at(id), estimate.belief, camera_.camera,
                               camera_.view.camera, camera_.settings);
    if (!match) continue;
    match->measured = feature.view.pixel;
    match->outcome = MatchOutcome::matched;
    corners.push_back(*std::move(match));
  }
  camera_.lasting.lend(estimate, camera_.settings.filter, corners);
  std::vector<LinearizedMeasurement> measurements;
  for (const FeatureMatch& corner : corners)
    measurements.push_back(linearized_measurement(corner, estimate.landmarks.at(corner.id), camera_));
  const SmallVector before = estimate.belief.mean(camera_.view.body);
  estimate.belief.update(measurements);
  if (camera_.settings.filter.invariant) keep_errors_invariant(estimate, camera_.view.body, before);
}

void FeatureTracker::start_lasting_errors(Estimate& estimate) {
  const auto anchors = placement_.target ? placement_.target->corners.size() : 0;
  const int most_landmarks = camera_.settings.map.max_landmarks + static_cast<int>(anchors);
  camera_.lasting.start(estimate, camera_.settings.filter,
                        std::min(most_in_view(camera_.settings, camera_.camera), most_landmarks));
}

void FeatureTracker::predict_lasting_errors(Estimate& estimate, double dt) const {
  camera_.lasting.predict(estimate, camera_.settings.filter, dt);
}

void FeatureTracker::lend_lasting_errors(Estimate& estimate) {
  camera_.lasting.lend(estimate, camera_.settings.filter, camera_.matches);
}

void FeatureTracker::align(const Estimate& estimate, const AnyMotion& motion) {
  camera_.guide.reset();
  if (!sees_ || !before_ || small_before_.empty()) return;
  if (small_rays_.empty()) small_rays_ = rays_of(small_, camera_.camera);
  const CameraState now = viewpoint(estimate, camera_, motion).camera;
  const Eigen::Matrix3d now_from_world = rotation_matrix<double>(free_camera::orientation(now)).transpose();
  const Eigen::Matrix3d now_from_before =
      now_from_world * rotation_matrix<double>(free_camera::orientation(*before_));
  const Eigen::Vector3d moved = now_from_world *
                                (free_camera::position(*before_) - free_camera::position(now)) /
                                camera_.median_depth_m;
  predicted_rays_.resize(small_rays_.size());
  std::ranges::transform(small_rays_, predicted_rays_.begin(),
                         [&](const Eigen::Vector3d& ray) -> Eigen::Vector3d {
                           if (ray.z() == 0) return ray;
                           return now_from_before * ray.normalized() + moved;
                         });
  const auto alignment = align_rotation(small_before_, small_, predicted_rays_, camera_.camera);
  if (alignment) camera_.guide = alignment->rotation;
}

std::optional<Eigen::Vector3d> FeatureTracker::unexpected_turn() const {
  constexpr double gate_sigmas = 2.5;
  if (!camera_.guide) return std::nullopt;
  int outside = 0;
  for (const FeatureMatch& match : camera_.matches) {
    const auto guided = guided_pixel(match, camera_);
    if (!guided) continue;
    const Eigen::Vector2d off = *guided - match.predicted;
    outside += off.dot(match.innovation_cov.inverse() * off) > gate_sigmas * gate_sigmas;
  }
  if (2 * outside <= static_cast<int>(camera_.matches.size())) return std::nullopt;
  // A ray of the prediction appears at guide * ray: the camera turned the other way
  return -quaternion_log(quaternion_from_matrix(*camera_.guide));
}

void FeatureTracker::predict(const Estimate& estimate, const AnyMotion& motion) {
  camera_.max_measurements =
      std::min(camera_.settings.map.wanted_visible,
               affordable_measurements(camera_.settings.search, estimate.belief.errors()));
  camera_.ray_matches.clear();
  camera_.ray_particles.clear();
  camera_.predicted = camera_.matched = 0;
  camera_.view = viewpoint(estimate, camera_, motion);
  predict_matches(estimate, camera_);
}

void FeatureTracker::search() {
  if (sees_) active_search(pyramid_, camera_);
}

void FeatureTracker::add_plane_uncertainty() {
  if (sees_) incognita::add_plane_uncertainty(pyramid_.image(), camera_);
}

void FeatureTracker::reject_outliers(const Estimate& estimate) {
  if (sees_) incognita::reject_outliers(estimate, camera_);
}

/// A measurement of a match with the noise that many of them have together.
LinearizedMeasurement FeatureTracker::with_lasting(LinearizedMeasurement measurement,
                                                   const FeatureMatch& match) const {
  if (measurement.part_count > 0)
    measurement.R.diagonal().array() += (camera_.lasting_factor - 1) * match_var(match, camera_);
  return measurement;
}

void FeatureTracker::append_measurements(const Estimate& estimate,
                                         std::vector<LinearizedMeasurement>& measurements) const {
  for (const FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched)
      measurements.push_back(
          with_lasting(linearized_measurement(match, estimate.landmarks.at(match.id), camera_), match));
}

void FeatureTracker::append_relinearized(const Estimate& estimate, const AnyMotion& motion,
                                         std::vector<LinearizedMeasurement>& measurements) {
  camera_.view = viewpoint(estimate, camera_, motion);
  for (const FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched)
      measurements.push_back(with_lasting(relinearized_measurement(match, estimate, camera_), match));
}

void FeatureTracker::discard_matches() {
  for (FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched) match.outcome = MatchOutcome::outlier;
  camera_.matched = 0;
}

void FeatureTracker::after_correction(const Estimate& estimate, const AnyMotion& motion) {
  camera_.view = viewpoint(estimate, camera_, motion);
  if (sees_) {
    before_ = camera_.view.camera;
    before_t_ = estimate.bodies[camera_.body].t;
  }
  if (camera_.settings.filter.adapt_sigma_pixel) pixel_noise_.update(estimate, camera_);
  if (sees_) rolling_shutter_.update(estimate, camera_, estimate.bodies[camera_.body].t);
  if (const auto depth_m = depth_of_view(estimate, camera_)) camera_.median_depth_m = *depth_m;
  estimate_patch_planes(estimate, camera_);
  const RelocalizationSettings& recognition = camera_.settings.relocalization;
  if (sees_ && (recognition.whole_map || recognition.close_loops))
    describe_new_views(pyramid_.image(), estimate, camera_);
}

std::optional<PoseEvidence> FeatureTracker::find_in_map(const Estimate& estimate, double t) {
  if (!sees_) return std::nullopt;
  return relocalization_.find(pyramid_.summed(), estimate, camera_, t);
}

std::optional<ClosedLoop> FeatureTracker::find_loop(const Estimate& estimate, double t) {
  if (!sees_) {
    loop_closure_.restart();
    return std::nullopt;
  }
  return loop_closure_.find(pyramid_.summed(), estimate, camera_, t);
}

void FeatureTracker::take_matches(PoseEvidence evidence, const Estimate& estimate) {
  camera_.view = viewpoint(estimate, camera_);
  camera_.matches = std::move(evidence.matches);
  camera_.predicted = static_cast<int>(camera_.matches.size());
  Eigen::MatrixXd S(2, 2);
  for (FeatureMatch& match : camera_.matches) {
    const LinearizedMeasurement measurement =
        linearized_measurement(match, estimate.landmarks.at(match.id), camera_);
    estimate.belief.innovation_covariance({&measurement, 1}, S);
    match.innovation_cov = S;
  }
  add_plane_uncertainty();
  const double more_var = std::max(0.0, least_sigma_px * least_sigma_px - camera_.pixel_var());
  for (FeatureMatch& match : camera_.matches) {
    match.plane_cov.diagonal().array() += more_var;
    match.innovation_cov.diagonal().array() += more_var;
  }
  reject_outliers(estimate);
}

void FeatureTracker::count_frames() {
  incognita::count_frames(camera_);
  if (reference_frames_) ++*reference_frames_;
}

void FeatureTracker::maintain_map(Estimate& estimate, const AnyMotion& motion) {
  relocalization_.restart();
  moved_estimate_ = false;
  if (!sees_) return;
  count_attempts(estimate, camera_);
  moved_estimate_ = camera_.settings.bundle.adjust && add_keyframe(estimate, motion);
  const std::int64_t newest = camera_.features.empty() ? -1 : camera_.features.rbegin()->first;
  simplify_landmarks(estimate, camera_);
  update_depth_lines(pyramid_.summed(), estimate, camera_);
  add_landmarks(estimate);
  if (moved_estimate_) add_new_landmarks_to_keyframe(newest);
  delete_bad_landmarks(estimate, camera_);
}

void FeatureTracker::forget_time() {
  restart_keyframes();
  moved_estimate_ = false;
  pixel_noise_ = {};
  rolling_shutter_ = {};
  relocalization_.restart();
  loop_closure_.restart();
  small_ = small_before_ = {};
  before_.reset();
  before_t_ = 0;
  camera_.lasting.take_back();
}

void FeatureTracker::adopt(std::int64_t id, Feature feature) { camera_.features[id] = std::move(feature); }

/// Adds the landmarks after `newest`, which began in this frame.
void FeatureTracker::add_new_landmarks_to_keyframe(std::int64_t newest) {
  for (auto feature = camera_.features.upper_bound(newest); feature != camera_.features.end(); ++feature)
    keyframes_.add_new(
        {feature->first, feature->second.view.pixel, camera_.pixel_var() * Eigen::Matrix2d::Identity()},
        camera_.depth_prior());
}

/// Covariance of the pose of a camera that is the body itself.
Eigen::Matrix<double, 6, 6> FeatureTracker::pose_cov(const Estimate& estimate) const {
  return estimate.belief.covariance(camera_.view.body).topLeftCorner(6, 6);
}

/// Whether this frame became a keyframe; bundle adjustment then moved the estimate.
bool FeatureTracker::add_keyframe(Estimate& estimate, const AnyMotion& motion) {
  const BundleSettings& settings = camera_.settings.bundle;
  std::vector<KeyframeMatch> matches;
  for (const FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched)
      matches.push_back(
          {match.id, *match.measured, match_cov(match, camera_),
           reference_frames_ && camera_.features.at(match.id).frames_known > *reference_frames_});
  const int width = camera_.camera.width();
  const KeyframePolicy policy{
      .min_frames = settings.min_frames,
      .min_motion_px = settings.min_motion_share * width,
      .min_start_motion_px = std::max(settings.min_start_motion_share * width,
                                      least_motion_sigmas * std::sqrt(camera_.pixel_var())),
      .min_matched_share = settings.min_matched_share};
  const bool filter_closed_loop =
      !keyframes_.is_starting() && keyframes_.returning_count(matches) >= least_returning &&
      keyframes_.moved_px(estimate, camera_.view.camera, camera_.camera) > most_moved_px;
  if (std::exchange(keyframes_are_old_, false) || filter_closed_loop) {
    keyframes_.start(camera_.view.camera, pose_cov(estimate), estimate.bodies[camera_.body].t);
    keyframes_.add_matches(estimate, camera_.view.body, matches);
    return false;
  }
  if (!keyframes_.is_due(matches, policy)) return false;
  const BundleView before = view_of(camera_.view.camera);
  keyframes_.add(estimate, camera_.view.body, matches, estimate.bodies[camera_.body].t);
  AdjustmentSettings adjustment;
  adjustment.max_iterations = settings.max_iterations;
  adjustment.robust.limit_sigmas = settings.limit_sigmas;
  const SmallVector unadjusted = estimate.belief.mean(camera_.view.body);
  keyframes_.adjust(estimate, camera_.view.body, camera_.camera, adjustment, camera_.depth_prior(),
                    settings.window);
  if (camera_.settings.filter.invariant) keep_errors_invariant(estimate, camera_.view.body, unadjusted);
  if (keyframes_.start_again(camera_.camera, adjustment)) {
    renew_map(keyframes_, estimate, camera_);
    pixel_noise_ = {};
  }
  estimate.last.adjusted = {{before.position, before.world_from_camera}, keyframes_.window()};
  camera_.view = viewpoint(estimate, camera_, motion);
  before_ = camera_.view.camera;
  return true;
}

void FeatureTracker::forget_depth_lines(Estimate& estimate) { drop_depth_lines(estimate, camera_); }

FeatureTracker::NewLandmarks FeatureTracker::new_landmarks(const Estimate& estimate) const {
  const int visible = static_cast<int>(std::lround(expected_matches(camera_)));
  int rays = 0, mapped = 0;
  for_each_feature(estimate, camera_.features, [&](const Landmark& landmark, const Feature&) {
    rays += landmark.form.kind == LandmarkParametrization::Kind::ray;
    mapped += landmark.mapped();
  });
  return {std::min(camera_.settings.initialization.max_new_per_frame,
                   camera_.settings.map.wanted_visible - visible - rays),
          camera_.settings.map.max_landmarks - mapped - rays};
}

/// Landmarks where the surface in view has none nearby, a few in each frame; their number.
int FeatureTracker::fill_gaps(Estimate& estimate) {
  constexpr int most_per_frame = 4;
  const double gap_m = camera_.settings.map.max_gap_m;
  if (gap_m == 0) return 0;
  const int possible = std::min(
      {new_landmarks(estimate).possible, most_per_frame, camera_.settings.initialization.max_new_per_frame});
  if (possible <= 0) return 0;
  int filled = 0;
  for (const Eigen::Vector2d& corner :
       find_new_corners(pyramid_.image(), estimate, camera_, possible, 0, gap_m))
    filled += initialize_from_image(pyramid_, corner, estimate, camera_);
  return filled;
}

void FeatureTracker::add_landmarks(Estimate& estimate) {
  const int filled = fill_gaps(estimate);
  auto [wanted, possible] = new_landmarks(estimate);
  wanted = std::min(wanted, camera_.settings.initialization.max_new_per_frame - filled);
  if (wanted > possible && camera_.settings.map.replace_when_full)
    possible += delete_least_matched(estimate, camera_, wanted - possible);
  wanted = std::min(wanted, possible);
  if (wanted <= 0) return;
  if (camera_.settings.initialization.selection == InitializationSettings::Selection::grid) {
    for (const Eigen::Vector2d& corner :
         find_new_corners(pyramid_.image(), estimate, camera_, wanted, cell_of_wanted_px(camera_), 0))
      initialize_from_image(pyramid_, corner, estimate, camera_);
    return;
  }
  for (int i = 0; i < wanted; ++i) {
    const auto corner = find_new_corner(pyramid_.image(), estimate, camera_, random_);
    if (!corner || !initialize_from_image(pyramid_, *corner, estimate, camera_)) return;
  }
}

namespace {

template <class SomeMatch>
Match image_match(const SomeMatch& match, const TrackedCamera& camera) {
  Match out;
  out.body = static_cast<int>(camera.body);
  out.sensor = camera.index;
  out.image = true;
  out.id = match.id;
  if (match.measured) out.measured = *match.measured;
  out.predicted = match.predicted;
  out.innovation_cov = match.innovation_cov;
  out.correlation = match.correlation;
  out.outcome = match.outcome;
  return out;
}

}  // namespace

void FeatureTracker::append_matches(FrameReport& report) const {
  for (const FeatureMatch& match : camera_.matches)
    report.matches.emplace_back(image_match(match, camera_)).anchor = match.anchor;
  const int before = static_cast<int>(report.particles.size());
  report.particles.insert(report.particles.end(), camera_.ray_particles.begin(), camera_.ray_particles.end());
  for (const RayMatch& match : camera_.ray_matches) {
    Match& ray = report.matches.emplace_back(image_match(match, camera_));
    ray.ray = true;
    ray.first_particle = before + match.first_particle;
    ray.particle_count = match.particle_count;
  }
}

}  // namespace incognita
