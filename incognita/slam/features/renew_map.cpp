#include "incognita/slam/features/renew_map.hpp"

#include <cmath>
#include <vector>

#include "incognita/slam/features/active_search.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/mapper/bodies.hpp"
#include "incognita/slam/mapper/invariant_errors.hpp"

namespace incognita {
namespace {

constexpr double least_var = 1e-8;          // keeps the covariance positive definite: the origin has none
constexpr double wide_rad = 1;              // of the pose before its matches correct it
constexpr double velocity_share = 0.5;      // of velocity and rate, from two keyframes
constexpr double least_rate_rad_s = 0.1;    // known no better
constexpr double least_depths_per_s = 0.1;  // velocity, in median depths

/// The landmark as it was when it began in the host, but for the mean of its depth. `pixel`: in the image of the host.
void begin_again(Landmark& landmark, const Eigen::Vector3d& point, const BundleView& host,
                 const Eigen::Vector2d& pixel, const TrackedCamera& camera, AnyBelief& belief) {
  CameraState from = CameraState::Zero();
  from.head<3>() = host.position;
  from.segment<4>(3) = host.world_from_camera;
  const auto initialized = InverseDepthLandmark::initialize(camera.camera, from, pixel, point.z());
  if (!initialized) return;
  InverseDepthLandmark::State y;
  y << host.position, point;
  Eigen::Matrix<double, 6, 6> cov = camera.pixel_var() * initialized->Jz * initialized->Jz.transpose();
  cov(5, 5) += std::pow(camera.depth_prior().sigma, 2);
  cov.topLeftCorner<5, 5>() += least_var * Eigen::Matrix<double, 5, 5>::Identity();
  landmark.form.kind = LandmarkParametrization::Kind::inverse_depth;
  landmark.form.initial_axes = host.world_from_camera;
  belief.drop(landmark.block);
  landmark.block = belief.augment(InverseDepthLandmark::chart, y, {}, cov);
}

void begin_landmarks_again(const Keyframes& keyframes, Estimate& estimate, TrackedCamera& camera) {
  std::vector<std::int64_t> others;
  for (auto& [id, feature] : camera.features) {
    Landmark& landmark = estimate.landmarks.at(id);
    if (landmark.fixed) continue;
    feature.described.clear();  // from poses that were wrong, as were the searches
    feature.attempts = 0;
    feature.recent_attempts = feature.recent_matches = 0;
    if (const auto point = keyframes.point_in_first_view(id))
      begin_again(landmark, *point, keyframes.first_view(), feature.view.pixel, camera, estimate.belief);
    else
      others.push_back(id);
  }
  for (const std::int64_t id : others) remove_landmark(estimate, camera, id);
}

void put_camera(const Keyframes& keyframes, Estimate& estimate, TrackedCamera& camera) {
  const BundleView &now = keyframes.last_view(), &before = keyframes.view_before();
  CameraState x = CameraState::Zero();
  x.head<3>() = now.position;
  x.segment<4>(3) = now.world_from_camera;
  const double elapsed_s = std::max(keyframes.elapsed_s(), 1e-3);
  x.segment<3>(7) = (now.position - before.position) / elapsed_s;
  x.tail<3>() = quaternion_log(quaternion_product(quaternion_conjugate(before.world_from_camera),
                                                  now.world_from_camera)) /
                elapsed_s;
  const double median_depth = 1 / camera.settings.initialization.inverse_depth_per_m;
  Eigen::Matrix<double, 12, 1> sigmas;
  sigmas.head<3>().setConstant(wide_rad * median_depth);
  sigmas.segment<3>(3).setConstant(wide_rad);
  sigmas.segment<3>(6).setConstant(
      std::max(velocity_share * x.segment<3>(7).norm(), least_depths_per_s * median_depth));
  sigmas.tail<3>().setConstant(std::max(velocity_share * x.tail<3>().norm(), least_rate_rad_s));
  put_body(estimate, camera.body, x, sigmas.cwiseAbs2().asDiagonal());
  restart_invariant_errors(estimate);
  camera.view = viewpoint(estimate, camera);
}

/// Which matches are outliers was judged by the map that was wrong.
void judge_matches_again(const Estimate& estimate, TrackedCamera& camera) {
  for (FeatureMatch& match : camera.matches) {
    if (match.outcome != MatchOutcome::matched && match.outcome != MatchOutcome::outlier) continue;
    match.second_order_cov.setZero();
    match.outcome = predict_again(match, estimate, camera, camera.view.camera) ? MatchOutcome::matched
                                                                               : MatchOutcome::outlier;
  }
  reject_outliers(estimate, camera);
}

}  // namespace

void renew_map(const Keyframes& keyframes, Estimate& estimate, TrackedCamera& camera) {
  camera.sigma_pixel_px.reset();
  camera.lasting_factor = 1;
  camera.lasting.take_back();
  camera.median_depth_m = 1 / camera.settings.initialization.inverse_depth_per_m;
  begin_landmarks_again(keyframes, estimate, camera);
  put_camera(keyframes, estimate, camera);
  std::erase_if(camera.matches,
                [&](const FeatureMatch& match) { return !estimate.landmarks.contains(match.id); });
  judge_matches_again(estimate, camera);
  std::vector<LinearizedMeasurement> measurements;
  for (const FeatureMatch& match : camera.matches)
    if (match.outcome == MatchOutcome::matched)
      measurements.push_back(linearized_measurement(match, estimate.landmarks.at(match.id), camera));
  const SmallVector before = estimate.belief.mean(camera.view.body);
  estimate.belief.update(measurements);
  if (camera.settings.filter.invariant) keep_errors_invariant(estimate, camera.view.body, before);
  camera.view = viewpoint(estimate, camera);
}

}  // namespace incognita
