#include "incognita/slam/features/predict_matches.hpp"

#include <Eigen/LU>
#include <cmath>

#include "incognita/slam/features/each_feature.hpp"

namespace incognita {
namespace {

/// Thesis C.4: whether the view is close enough to the initial view, in angle and distance, for the patch to match.
bool same_view_as_initial(const Eigen::Vector3d& first_view, const Eigen::Vector3d& point,
                          const CameraState& from, const MapSettings& settings) {
  const Eigen::Vector3d now = point - free_camera::position(from);
  const Eigen::Vector3d then = point - first_view;
  const double now_m = now.norm(), then_m = then.norm();
  if (now_m < 1e-6 || then_m < 1e-6) return false;
  if (now.dot(then) < std::cos(settings.max_view_angle_rad) * now_m * then_m) return false;
  return now_m < then_m * settings.max_scale && then_m < now_m * settings.max_scale;
}

}  // namespace

Eigen::Vector3d nominal_position(const Landmark& landmark, const AnyBelief& belief) {
  if (landmark.fixed) return landmark.position;
  if (landmark.form.kind == LandmarkParametrization::Kind::point) return belief.mean(landmark.block);
  InverseDepthLandmark::State y = belief.mean(landmark.block);
  if (!(y[5] > 1e-6)) y[5] = 0.01;
  return InverseDepthLandmark{landmark.form.initial_axes}.point(y).position;
}

std::optional<Eigen::Matrix2d> local_warp(const PatchView& view, const Eigen::Vector3d& normal,
                                          const Eigen::Vector3d& point, const Eigen::Vector2d& pixel,
                                          const Camera& camera, const CameraState& from) {
  const Eigen::Matrix3d world_from_camera = rotation_matrix<double>(free_camera::orientation(from));
  const Eigen::Matrix3d initial_camera_from_world =
      rotation_matrix<double>(view.world_from_camera).transpose();
  const Eigen::Vector3d position = free_camera::position(from);
  const double height = normal.dot(point - position);
  if (height >= 0) return std::nullopt;  // from behind
  constexpr double step_px = 3;          // half a patch: an average over the patch instead of the tangent
  Eigen::Matrix2d warp;
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Vector2d moved[2];
    for (int side = 0; side < 2; ++side) {
      Eigen::Vector2d at = pixel;
      at[axis] += side == 0 ? -step_px : step_px;
      const auto ray = camera.unproject(at);
      if (!ray) return std::nullopt;
      const Eigen::Vector3d along = world_from_camera * *ray;
      const double closing = normal.dot(along);
      if (height * closing <= 1e-6 * std::abs(height)) return std::nullopt;
      const Eigen::Vector3d on_plane = position + along * (height / closing);
      const auto projected = camera.project(initial_camera_from_world * (on_plane - view.camera_position));
      if (!projected) return std::nullopt;
      moved[side] = projected->pixel;
    }
    warp.col(axis) = (moved[1] - moved[0]) / (2 * step_px);
  }
  return warp;
}

std::optional<FeatureMatch> predict_pixel(const Landmark& landmark, const AnyBelief& belief,
                                          const Camera& camera, const CameraState& from,
                                          const CameraSlamSettings& settings) {
  FeatureMatch match{};
  match.id = landmark.id;
  match.anchor = landmark.fixed;
  if (!landmark.fixed && landmark.form.kind == LandmarkParametrization::Kind::inverse_depth) {
    const auto prediction = InverseDepthLandmark{landmark.form.initial_axes}.predict_measurement(
        camera, from, belief.mean(landmark.block));
    if (!prediction) return std::nullopt;
    match.predicted = prediction->pixel;
    match.Hv = prediction->Hv;
    match.Hl = prediction->Hl;
    match.by_parallax = prediction->by_parallax;
  } else {
    const Eigen::Vector3d point =
        landmark.fixed ? Eigen::Vector3d(landmark.position) : Eigen::Vector3d(belief.mean(landmark.block));
    const auto prediction = PointLandmark::predict_measurement(camera, from, point);
    if (!prediction) return std::nullopt;
    match.predicted = prediction->pixel;
    match.Hv = prediction->Hv;
    if (landmark.fixed)
      match.Hl.resize(2, 0);
    else
      match.Hl = prediction->Hl;
  }
  if (!camera.contains(match.predicted, settings.search.patch_size_px / 2 + 1)) return std::nullopt;
  match.point = nominal_position(landmark, belief);
  if (!same_view_as_initial(landmark.first_view, match.point, from, settings.map)) return std::nullopt;
  return match;
}

std::optional<FeatureMatch> predict_match(const Landmark& landmark, const PatchView& view,
                                          const AnyBelief& belief, const Camera& camera,
                                          const CameraState& from, const CameraSlamSettings& settings) {
  std::optional<FeatureMatch> match = predict_pixel(landmark, belief, camera, from, settings);
  if (!match) return std::nullopt;
  const auto warp = local_warp(view, view.plane.normal(), match->point, match->predicted, camera, from);
  if (!warp) return std::nullopt;
  match->texture_from_view = *warp;
  return match;
}

namespace {

double variance_at(int level, double var) { return var * static_cast<double>(1 << (2 * level)); }

/// The mean of the error of a match that lasts, px.
Eigen::Vector2d lasting_mean(std::int64_t landmark, const AnyBelief& belief, const TrackedCamera& camera) {
  const auto lasting = camera.lasting.of(landmark);
  if (!lasting) return Eigen::Vector2d::Zero();
  return belief.mean(*lasting);
}

Eigen::Matrix2d error_cov(std::int64_t landmark, const AnyBelief& belief, const TrackedCamera& camera) {
  const auto lasting = camera.lasting.of(landmark);
  if (!lasting) return camera.error_var() * Eigen::Matrix2d::Identity();
  return camera.pixel_var() * Eigen::Matrix2d::Identity() + belief.covariance(*lasting);
}

}  // namespace

double match_var(const FeatureMatch& match, const TrackedCamera& camera) {
  return variance_at(match.level, camera.pixel_var());
}

Eigen::Matrix2d match_cov(const FeatureMatch& match, const TrackedCamera& camera) {
  return variance_at(match.level, camera.error_var()) * Eigen::Matrix2d::Identity() + match.plane_cov;
}

LinearizedMeasurement linearized_measurement(const FeatureMatch& match, const Landmark& landmark,
                                             const TrackedCamera& camera) {
  LinearizedMeasurement measurement;
  measurement.add(camera.view.body, camera.view.jacobian(match.Hv));
  if (!landmark.fixed) measurement.add(landmark.block, match.Hl);
  measurement.residual = Eigen::Vector2d::Zero();
  if (match.measured) measurement.residual = *match.measured - match.predicted;
  if (const auto lasting = camera.lasting.of(match.id)) {
    measurement.add(*lasting, Eigen::Matrix2d::Identity());
    measurement.R = match_var(match, camera) * Eigen::Matrix2d::Identity() + match.second_order_cov;
  } else {
    measurement.R = match_cov(match, camera) + match.second_order_cov;
  }
  return measurement;
}

bool predict_again(FeatureMatch& match, const Estimate& estimate, const TrackedCamera& camera,
                   const CameraState& from) {
  const auto now =
      predict_pixel(estimate.landmarks.at(match.id), estimate.belief, camera.camera, from, camera.settings);
  if (!now) return false;
  match.predicted = now->predicted + lasting_mean(match.id, estimate.belief, camera);
  match.Hv = now->Hv;
  match.Hl = now->Hl;
  return true;
}

LinearizedMeasurement relinearized_measurement(const FeatureMatch& match, const Estimate& estimate,
                                               const TrackedCamera& camera) {
  FeatureMatch again = match;
  if (!predict_again(again, estimate, camera, camera.view.camera)) return {};
  return linearized_measurement(again, estimate.landmarks.at(match.id), camera);
}

namespace {

/// The product of the errors of the inverse depth rho and of the baseline b, from the camera to the initial position, which
/// linearization leaves out: while a camera hardly moved its measurements seem not to depend on the depth at all. Its mean,
/// cov(b, rho), shifts the prediction; its covariance, var(rho) cov(b) + cov(b, rho) cov(b, rho)', is noise
/// (second-order filter: Bar-Shalom, Li, Kirubarajan 2001, Section 10.3.2).
void add_second_order(FeatureMatch& match, const Landmark& landmark, const AnyBelief& belief,
                      const Viewpoint& view) {
  if (landmark.fixed || landmark.form.kind != LandmarkParametrization::Kind::inverse_depth) return;
  const BlockMatrix own = belief.covariance(landmark.block), body = belief.covariance(view.body);
  const BlockMatrix cross = belief.covariance(landmark.block, view.body);
  const SmallMatrix position = view.by_body.size() == 0 ? SmallMatrix(SmallMatrix::Identity(3, body.rows()))
                                                        : SmallMatrix(view.by_body.topRows(3));
  const Eigen::Matrix<double, 6, 3> to_camera = cross * position.transpose();
  const Eigen::Matrix3d mixed = to_camera.topRows<3>();
  const Eigen::Matrix3d baseline_cov =
      own.topLeftCorner<3, 3>() + position * body * position.transpose() - mixed - mixed.transpose();
  const Eigen::Vector3d with_depth = own.block<3, 1>(0, 5) - to_camera.row(5).transpose();
  const Eigen::Vector2d shift = match.by_parallax * with_depth;
  match.predicted += shift;
  match.second_order_cov = own(5, 5) * match.by_parallax * baseline_cov * match.by_parallax.transpose() +
                           shift * shift.transpose();
}

}  // namespace

void predict_matches(const Estimate& estimate, TrackedCamera& camera) {
  camera.matches.clear();
  Eigen::MatrixXd S(2, 2);
  for_each_feature(estimate, camera.features, [&](const Landmark& landmark, const Feature& feature) {
    if (landmark.form.kind == LandmarkParametrization::Kind::ray) return;
    auto match = predict_match(landmark, feature.view, estimate.belief, camera.camera, camera.view.camera,
                               camera.settings);
    if (!match) return;
    if (camera.settings.initialization.second_order)
      add_second_order(*match, landmark, estimate.belief, camera.view);
    match->predicted += lasting_mean(landmark.id, estimate.belief, camera);
    match->error_cov = error_cov(landmark.id, estimate.belief, camera);
    const LinearizedMeasurement measurement = linearized_measurement(*match, landmark, camera);
    estimate.belief.innovation_covariance({&measurement, 1}, S);
    match->innovation_cov = S;
    camera.matches.push_back(*std::move(match));
  });
}

}  // namespace incognita
