#include "incognita/slam/features/feature_tracker.hpp"

#include <cmath>
#include <stdexcept>

#include "incognita/slam/features/active_search.hpp"
#include "incognita/slam/features/depth_line.hpp"
#include "incognita/slam/features/each_feature.hpp"
#include "incognita/slam/features/estimate_patch_planes.hpp"
#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/features/recognition.hpp"
#include "incognita/slam/features/validation.hpp"

namespace incognita {
namespace {

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
    : camera_{.camera = std::move(camera),
              .settings = settings,
              .body = placement.body,
              .mount = placement.mount},
      placement_(placement),
      relocalization_(seed),
      random_(seed, "slam.birth") {
  validate(settings, placement.target, placement.max_search_s);
}

void FeatureTracker::set_index(int index) { camera_.index = index; }

void FeatureTracker::see(const Image* image) {
  sees_ = image && !image->empty();
  if (!sees_) return;
  check_size(*image, camera_.camera);
  summed_.assign(*image);
}

FeatureTracker::Start FeatureTracker::find_start(double waited_s) const {
  Start start;
  start.reason = "no image yet";
  if (sees_ && !placement_.target)
    return {true, false, {}, "started without a target: the scale is not observable"};
  if (sees_) {
    TargetSearch search =
        find_target(*placement_.target, camera_.camera, summed_, camera_.settings.filter.sigma_pixel_px);
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
  for (std::size_t i = 0; pose && i < placement_.target->corners.size(); ++i) {
    auto view =
        cut_view(summed_.image(), pose->pixels[i], camera_.view.camera, camera_.camera, camera_.settings);
    if (!view) continue;
    view->plane.facing = placement_.target->normal;
    view->plane.slope_cov.setZero();
    add_anchor(placement_.target->corners[i].position, *std::move(view), estimate, camera_);
  }
  // The first map is initialized at once: without a target there is nothing else to track
  for (;;) {
    const std::size_t before = camera_.features.size();
    predict_matches(estimate, camera_);
    add_landmarks(estimate);
    if (camera_.features.size() == before) break;
  }
  if (!camera_.settings.bundle.adjust) return;
  keyframes_.start(camera_.view.camera, estimate.belief.covariance(camera_.view.body).topLeftCorner<6, 6>());
  add_new_landmarks_to_keyframe();
}

void FeatureTracker::predict(const Estimate& estimate, const AnyMotion& motion) {
  camera_.ray_matches.clear();
  camera_.ray_particles.clear();
  camera_.predicted = camera_.matched = 0;
  camera_.view = viewpoint(estimate, camera_, motion);
  predict_matches(estimate, camera_);
}

void FeatureTracker::search() {
  if (sees_) active_search(summed_, camera_);
}

void FeatureTracker::add_plane_uncertainty() {
  if (sees_) incognita::add_plane_uncertainty(summed_.image(), camera_);
}

void FeatureTracker::reject_outliers(const Estimate& estimate) {
  if (sees_) incognita::reject_outliers(estimate, camera_);
}

void FeatureTracker::append_measurements(const Estimate& estimate,
                                         std::vector<LinearizedMeasurement>& measurements) const {
  for (const FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched)
      measurements.push_back(linearized_measurement(match, estimate.landmarks.at(match.id), camera_));
}

void FeatureTracker::append_relinearized(const Estimate& estimate, const AnyMotion& motion,
                                         std::vector<LinearizedMeasurement>& measurements) {
  camera_.view = viewpoint(estimate, camera_, motion);
  for (const FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched)
      measurements.push_back(relinearized_measurement(match, estimate, camera_));
}

void FeatureTracker::discard_matches() {
  for (FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched) match.outcome = MatchOutcome::outlier;
  camera_.matched = 0;
}

void FeatureTracker::after_correction(const Estimate& estimate, const AnyMotion& motion) {
  camera_.view = viewpoint(estimate, camera_, motion);
  estimate_patch_planes(estimate, camera_);
  if (sees_ && camera_.settings.relocalization.whole_map)
    describe_new_views(summed_.image(), estimate, camera_);
}

std::optional<PoseEvidence> FeatureTracker::evidence_of_matches(const Estimate& estimate) const {
  if (!sees_ || camera_.matched == 0) return std::nullopt;
  PoseEvidence evidence = gather_evidence(summed_, estimate, camera_);
  if (!refusal_of(evidence, camera_.camera, camera_.settings).empty()) return std::nullopt;
  return evidence;
}

std::optional<PoseEvidence> FeatureTracker::find_in_map(const Estimate& estimate, double t) {
  if (!sees_) return std::nullopt;
  return relocalization_.find(summed_, estimate, camera_, t);
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
  reject_outliers(estimate);
}

void FeatureTracker::count_frames_away() { incognita::count_frames_away(camera_); }

void FeatureTracker::maintain_map(Estimate& estimate, const AnyMotion& motion) {
  relocalization_.restart();
  if (!sees_) return;
  count_attempts(estimate, camera_);
  if (camera_.settings.bundle.adjust) {
    maintain_keyframes(estimate, motion);
    delete_bad_landmarks(estimate, camera_);
    return;
  }
  simplify_landmarks(estimate, camera_);
  update_depth_lines(summed_, estimate, camera_);
  add_landmarks(estimate);
  delete_bad_landmarks(estimate, camera_);
}

void FeatureTracker::adopt(std::int64_t id, Feature feature) {
  if (camera_.settings.bundle.adjust)
    throw std::logic_error(
        "bundle.adjust = true: no keyframe has seen the landmarks of a saved map; take `false`");
  camera_.features[id] = std::move(feature);
}

void FeatureTracker::add_new_landmarks_to_keyframe() {
  for (const auto& [id, feature] : camera_.features)
    keyframes_.add_if_new({id, feature.view.pixel, camera_.pixel_var() * Eigen::Matrix2d::Identity()});
}

/// Bundle adjustment when this frame becomes a keyframe, and then new landmarks.
void FeatureTracker::maintain_keyframes(Estimate& estimate, const AnyMotion& motion) {
  const BundleSettings& settings = camera_.settings.bundle;
  std::vector<KeyframeMatch> matches;
  for (const FeatureMatch& match : camera_.matches)
    if (match.outcome == MatchOutcome::matched)
      matches.push_back(
          {match.id, *match.measured, camera_.pixel_var() * Eigen::Matrix2d::Identity() + match.plane_cov});
  const KeyframePolicy policy{settings.min_frames, settings.min_motion_share * camera_.camera.width(),
                              settings.min_matched_share};
  if (!keyframes_.is_due(matches, policy)) return;
  keyframes_.add(camera_.view.camera, matches);
  AdjustmentSettings adjustment;
  adjustment.max_iterations = settings.max_iterations;
  adjustment.robust.limit_sigmas = settings.limit_sigmas;
  const InitializationSettings& initialization = camera_.settings.initialization;
  keyframes_.adjust(estimate, camera_.view.body, camera_.camera, adjustment,
                    {initialization.inverse_depth_per_m, initialization.sigma_inverse_depth_per_m});
  for_each_feature(estimate, camera_.features, [&](Landmark& landmark, Feature& feature) {
    const BundleView* host = keyframes_.host_of(landmark.id);
    if (!host) return;
    landmark.first_view = feature.view.camera_position = host->position;
    feature.view.world_from_camera = host->world_from_camera;
  });
  simplify_landmarks(estimate, camera_);
  camera_.view = viewpoint(estimate, camera_, motion);
  add_landmarks(estimate);
  add_new_landmarks_to_keyframe();
}

void FeatureTracker::forget_depth_lines(Estimate& estimate) { drop_depth_lines(estimate, camera_); }

void FeatureTracker::add_landmarks(Estimate& estimate) {
  const InitializationSettings& initialization = camera_.settings.initialization;
  const int visible = static_cast<int>(std::lround(expected_matches(camera_)));
  int rays = 0, mapped = 0;
  for_each_feature(estimate, camera_.features, [&](const Landmark& landmark, const Feature&) {
    rays += landmark.form.kind == LandmarkParametrization::Kind::ray;
    mapped += landmark.mapped();
  });
  for (int i = 0; i < initialization.max_new_per_frame; ++i) {
    if (visible + rays + i >= camera_.settings.map.wanted_visible) return;
    if (mapped + rays >= camera_.settings.map.max_landmarks) return;
    const auto corner = find_new_corner(summed_.image(), estimate, camera_, random_);
    if (!corner || !initialize_from_image(summed_.image(), *corner, estimate, camera_)) return;
    if (initialization.method == InitializationSettings::Method::inverse_depth) ++mapped;
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
