#include "incognita/slam/features/camera_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "incognita/slam/features/active_search.hpp"
#include "incognita/slam/features/camera_validation.hpp"
#include "incognita/slam/features/depth_line.hpp"
#include "incognita/slam/features/entropy.hpp"
#include "incognita/slam/features/estimate_patch_planes.hpp"
#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/features/target_pose.hpp"
#include "incognita/slam/features/tracking.hpp"
#include "incognita/slam/features/wheel_odometry_update.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"

namespace incognita {
namespace {

constexpr int matches_to_recover = 6;          // from lost: more than false matches give
constexpr double lost_sigma_position_m = 0.1;  // of the search around the pose where it was lost
constexpr double lost_sigma_rotation_rad = 0.1;

void check_size(const Image& image, const Camera& camera) {
  if (image.width() != camera.width() || image.height() != camera.height())
    throw std::invalid_argument("image is " + std::to_string(image.width()) + "x" +
                                std::to_string(image.height()) + ", the camera is calibrated for " +
                                std::to_string(camera.width()) + "x" + std::to_string(camera.height()));
}

}  // namespace

CameraEstimator::CameraEstimator(Camera camera, std::optional<Target> target,
                                 const CameraSlamSettings& settings, double max_search_s, std::uint64_t seed,
                                 const std::optional<WheelOdometry>& odometry)
    : camera_(std::move(camera)),
      target_(std::move(target)),
      settings_(settings),
      max_search_s_(max_search_s),
      odometry_(odometry),
      random_(seed, "slam.birth") {
  validate(settings_, target_, max_search_s_, odometry_);
}

void CameraEstimator::update(Estimate& estimate, const Command& command, const Observation& observation,
                             const Tick& tick) {
  StageClock clock(estimate.timing_ms);
  estimate.matches.clear();
  estimate.line_matches.clear();
  estimate.predicted = estimate.matched = estimate.visible = 0;
  estimate.update = {};
  if (!estimate.first_t) estimate.first_t = tick.t;
  const SummedImage* image = nullptr;
  const BodyObservation& body = of_first_body(observation);
  if (body.image && !body.image->empty()) {
    check_size(*body.image, camera_);
    summed_.assign(*body.image);
    image = &summed_;
  }
  clock.mark("sums");
  if (!estimate.started) {
    start(estimate, image, tick, clock);
  } else if (estimate.status.state == TrackingState::lost) {
    wait_in_place(estimate, image);
  } else {
    predict(estimate, command, tick.dt);
    // Before the search, because it shrinks the search ellipses
    if (odometry_ && !body.odometry.empty())
      update_with_wheel_odometry(estimate.belief, estimate.camera, *odometry_, body.odometry.back().input);
    track(estimate, image, tick, clock);
  }
}

void CameraEstimator::start(Estimate& estimate, const SummedImage* summed, const Tick& tick,
                            StageClock& clock) {
  estimate.status.state = TrackingState::starting;
  if (!summed) {
    estimate.status.reason = "no image yet";
    return;
  }
  const Image& image = summed->image();
  CameraState x = CameraState::Zero();
  if (!target_) {  // the first view is the origin, level, looking along x
    const Eigen::Matrix3d world_from_camera = (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
    x.segment<4>(3) = quaternion_from_matrix(world_from_camera);
    start_at(estimate, x, 1e-8 * Eigen::Matrix<double, 6, 6>::Identity());
    estimate.status.reason = "started without a target: the scale is not observable";
  } else {
    const TargetSearch search = find_target(*target_, camera_, *summed, settings_.filter.sigma_pixel_px);
    if (!search.pose) {
      estimate.status.reason = search.reason;
      if (tick.t - *estimate.first_t > max_search_s_) estimate.status.state = TrackingState::lost;
      return;
    }
    x.head<3>() = search.pose->position;
    x.segment<4>(3) = search.pose->world_from_camera;
    start_at(estimate, x, search.pose->covariance);
    for (std::size_t i = 0; i < target_->corners.size(); ++i) {
      auto view = cut_view(image, search.pose->pixels[i], x, camera_, settings_);
      if (!view) continue;
      Landmark anchor;
      anchor.id = estimate.next_id++;
      anchor.kind = Landmark::Kind::anchor;
      anchor.anchor = target_->corners[i].position;
      anchor.view = *std::move(view);
      anchor.view.plane.facing = target_->normal;
      anchor.view.plane.slope_cov.setZero();
      estimate.catalog.push_back(std::move(anchor));
    }
    estimate.status.reason =
        "target " + target_->name + " found, " + std::to_string(search.pose->rms_px) + " px rms";
  }
  estimate.status.state = TrackingState::tracking;
  // The first map is initialized at once: without a target there is nothing else to track
  for (;;) {
    const std::size_t before = estimate.catalog.size();
    predict_matches(estimate, camera_, settings_, estimate.matches);
    add_landmarks(estimate, image);
    if (estimate.catalog.size() == before) break;
  }
  refresh_entropy(estimate, tick);
  clock.mark("start");
}

void CameraEstimator::start_at(Estimate& estimate, const CameraState& x,
                               const Eigen::Matrix<double, 6, 6>& pose_cov) {
  FreeCameraMotion::Jacobian P = FreeCameraMotion::Jacobian::Zero();
  P.topLeftCorner<6, 6>() = pose_cov;
  P.diagonal().segment<3>(6).setConstant(std::pow(settings_.filter.sigma_start_velocity_m_s, 2));
  P.diagonal().segment<3>(9).setConstant(std::pow(settings_.filter.sigma_start_angular_rate_rad_s, 2));
  estimate.camera = estimate.belief.add_vehicle(FreeCameraMotion::chart, x, P);
  estimate.started = true;
}

void CameraEstimator::predict(Estimate& estimate, const Command& command, double dt) const {
  const auto step = FreeCameraMotion{}.step(estimate.camera_state(), command.as_input(), dt);
  Eigen::Matrix<double, 6, 1> variances;
  variances.head<3>().setConstant(std::pow(settings_.filter.sigma_acceleration_m_s2, 2));
  variances.tail<3>().setConstant(std::pow(settings_.filter.sigma_angular_acceleration_rad_s2, 2));
  estimate.belief.predict(
      {estimate.camera, step.x, step.F, step.G * variances.asDiagonal() * step.G.transpose()});
}

void CameraEstimator::correct(Estimate& estimate) const {
  std::vector<LinearizedMeasurement> measurements;
  for (const FeatureMatch& match : estimate.matches)
    if (match.outcome == MatchOutcome::matched)
      measurements.push_back(linearized_measurement(match, estimate.catalog[match.landmark], estimate.camera,
                                                    settings_.filter.sigma_pixel_px));
  estimate.update = estimate.belief.update(measurements);
}

void CameraEstimator::track(Estimate& estimate, const SummedImage* summed, const Tick& tick,
                            StageClock& clock) {
  predict_matches(estimate, camera_, settings_, estimate.matches);
  estimate.visible = static_cast<int>(estimate.matches.size());
  clock.mark("predict");
  if (summed) match(estimate, *summed, clock);
  count_frames_away(estimate);
  estimate.status =
      assess(estimate.status, estimate.matched, estimate.predicted, sigma_position(estimate), settings_);
  if (estimate.status.state == TrackingState::lost) return declare_lost(estimate);
  if (summed && estimate.status.state == TrackingState::tracking) maintain_map(estimate, *summed, clock);
  refresh_entropy(estimate, tick);
  clock.mark("map");
}

void CameraEstimator::match(Estimate& estimate, const SummedImage& summed, StageClock& clock) {
  estimate.predicted = active_search(summed, estimate.catalog, settings_.search, estimate.matches);
  clock.mark("search");
  add_plane_uncertainty(estimate, camera_, summed.image(), settings_.search.patch_size_px, estimate.matches);
  clock.mark("planes");
  estimate.matched = reject_outliers(estimate, settings_, estimate.matches);
  clock.mark("consensus");
  correct(estimate);
  if (estimate.update.outcome == UpdateReport::Outcome::singular) estimate.matched = 0;  // none was applied
  if (estimate.update.outcome == UpdateReport::Outcome::updated)
    estimate_patch_planes(estimate, estimate.matches);
  clock.mark("update");
}

void CameraEstimator::maintain_map(Estimate& estimate, const SummedImage& summed, StageClock& clock) {
  count_attempts(estimate);
  simplify_landmarks(estimate, settings_.initialization);
  update_depth_lines(summed, estimate, camera_, settings_);
  clock.mark("lines");
  add_landmarks(estimate, summed.image());
  clock.mark("births");
  delete_bad_landmarks(estimate, settings_.map);
}

/// Stops the camera at its last pose and adds the uncertainty of a short search around it.
void CameraEstimator::declare_lost(Estimate& estimate) const {
  CameraState x = estimate.camera_state();
  x.tail<6>().setZero();
  FreeCameraMotion::Jacobian N = FreeCameraMotion::Jacobian::Zero();
  N.diagonal().head<3>().setConstant(std::pow(lost_sigma_position_m, 2));
  N.diagonal().segment<3>(3).setConstant(std::pow(lost_sigma_rotation_rad, 2));
  N.diagonal().segment<3>(6).setConstant(std::pow(settings_.filter.sigma_start_velocity_m_s, 2));
  N.diagonal().segment<3>(9).setConstant(std::pow(settings_.filter.sigma_start_angular_rate_rad_s, 2));
  FreeCameraMotion::Jacobian A = FreeCameraMotion::Jacobian::Identity();
  A.bottomRightCorner<6, 6>().setZero();
  estimate.belief.predict({estimate.camera, x, A, N});
  std::erase_if(estimate.catalog, [&](const Landmark& landmark) {
    if (landmark.kind != Landmark::Kind::line) return false;
    estimate.belief.drop(landmark.block);
    return true;
  });
}

/// Lost: searches for the map from the last pose at every frame, until enough consistent matches relocate it.
void CameraEstimator::wait_in_place(Estimate& estimate, const SummedImage* summed) {
  if (!estimate.started || !summed) return;
  predict_matches(estimate, camera_, settings_, estimate.matches);
  estimate.visible = static_cast<int>(estimate.matches.size());
  estimate.predicted = active_search(*summed, estimate.catalog, settings_.search, estimate.matches);
  add_plane_uncertainty(estimate, camera_, summed->image(), settings_.search.patch_size_px, estimate.matches);
  estimate.matched = reject_outliers(estimate, settings_, estimate.matches);
  const bool enough = estimate.matched >= std::min(matches_to_recover, settings_.search.max_measurements);
  if (enough) correct(estimate);
  if (!enough || !(sigma_position(estimate) <= settings_.lost.max_sigma_position_m)) {
    if (enough) declare_lost(estimate);  // matched but still uncertain: search around that pose
    for (FeatureMatch& match : estimate.matches)
      if (match.outcome == MatchOutcome::matched) match.outcome = MatchOutcome::outlier;
    estimate.matched = 0;
    estimate.update = {};
    return;
  }
  estimate.status = {TrackingState::relocated, std::to_string(estimate.matched) + " features matched again",
                     0};
}

void CameraEstimator::add_landmarks(Estimate& estimate, const Image& image) {
  int visible = 0, lines = 0;
  for (const FeatureMatch& match : estimate.matches) visible += match.kind != Landmark::Kind::line;
  for (const Landmark& landmark : estimate.catalog) lines += landmark.kind == Landmark::Kind::line;
  for (int i = 0; i < settings_.initialization.max_new_per_frame; ++i) {
    if (visible + lines + i >= settings_.map.wanted_visible) return;
    if (estimate.mapped_count() + lines >= settings_.map.max_landmarks) return;
    const auto corner = find_new_corner(image, estimate, camera_, settings_, random_);
    if (!corner) return;
    if (!initialize_landmark(image, *corner, estimate, camera_, settings_)) return;
  }
}

void CameraEstimator::refresh_entropy(Estimate& estimate, const Tick& tick) {
  const double period_s = entropy_period_s(estimate.belief.errors());
  if (!estimate.entropy_t || has_come(*estimate.entropy_t + period_s, tick.t)) {
    estimate.entropy = all_entropies(estimate);
    estimate.entropy_t = tick.t;
  } else {
    estimate.entropy.vehicle = vehicle_entropy(estimate);
  }
}

}  // namespace incognita
