#include "incognita/models/sensors/stereo_camera.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>

namespace incognita {

void StereoCamera::check() const {
  if (!(std::isfinite(baseline_m) && baseline_m > 0))
    throw std::invalid_argument("stereo baseline_m must be positive, got " + std::to_string(baseline_m));
  if (!(std::isfinite(least_disparity_px) && least_disparity_px >= 0))
    throw std::invalid_argument("stereo least_disparity_px must be zero or positive, got " +
                                std::to_string(least_disparity_px));
}

namespace {

/// `seen_from(camera)`: the prediction for one camera of the pair.
template <class Prediction, class SeenFrom>
std::optional<Prediction> predict_stereo(const CameraState& left, double baseline_m,
                                         const SeenFrom& seen_from) {
  const Eigen::Matrix3d axes = rotation_matrix<double>(free_camera::orientation(left));
  const Eigen::Vector3d lever = baseline_m * Eigen::Vector3d::UnitX();
  CameraState right = left;
  right.head<3>() += axes * lever;
  const auto by_left = seen_from(left);
  const auto by_right = seen_from(right);
  if (!by_left || !by_right) return std::nullopt;
  Prediction prediction{
      {by_left->pixel.x(), by_left->pixel.y(), by_right->pixel.x()}, by_right->pixel, {}, {}};
  prediction.Hv << by_left->Hv, by_right->Hv.row(0);
  // A rotation of the pair by e also translates the right camera by axes (e x lever)
  prediction.Hv.template block<1, 3>(2, 3) -=
      prediction.Hv.template block<1, 3>(2, 0) * axes * skew<double>(lever);
  prediction.Hl << by_left->Hl, by_right->Hl.row(0);
  return prediction;
}

}  // namespace

std::optional<StereoCamera::Prediction> StereoCamera::predict_measurement(
    const CameraState& left, const Eigen::Vector3d& point) const {
  return predict_stereo<Prediction>(left, baseline_m, [&](const CameraState& from) {
    return PointLandmark::predict_measurement(camera, from, point);
  });
}

std::optional<StereoCamera::InverseDepthPrediction> StereoCamera::predict_measurement(
    const CameraState& left, const InverseDepthLandmark& form, const InverseDepthLandmark::State& y) const {
  return predict_stereo<InverseDepthPrediction>(
      left, baseline_m, [&](const CameraState& from) { return form.predict_measurement(camera, from, y); });
}

/// The inverse depth (1/m) at which a point on the left ray (x, y, 1) projects to column `u_right` of the
/// right image: damped Newton steps from infinity. Without distortion the first step is exact.
std::optional<double> StereoCamera::inverse_depth(const Eigen::Vector3d& ray, double u_right) const {
  constexpr double close_enough_px = 1e-11;
  const auto seen_at = [&](double rho) {
    return camera.project(ray - rho * baseline_m * Eigen::Vector3d::UnitX());
  };
  double rho = 0;
  auto seen = seen_at(rho);
  for (int steps = 0; steps < 50 && seen; ++steps) {
    const double missing = u_right - seen->pixel.x();
    if (std::abs(missing) < close_enough_px * (1 + std::abs(u_right))) return rho;
    double step = -missing / (seen->J(0, 0) * baseline_m);
    int halvings = 0;
    for (; halvings < 40; ++halvings, step *= 0.5) {
      const auto next = seen_at(rho + step);
      if (!next || !(std::abs(u_right - next->pixel.x()) < std::abs(missing))) continue;
      rho += step;
      seen = next;
      break;
    }
    if (halvings == 40) return std::nullopt;  // no such column, or no convergence in the last digit
  }
  return std::nullopt;
}

std::optional<StereoCamera::Initialization> StereoCamera::initialize(const CameraState& left,
                                                                     const Eigen::Vector3d& z) const {
  if (!(z[0] - z[2] > least_disparity_px)) return std::nullopt;
  const auto ray = camera.unproject(z.head<2>());
  if (!ray) return std::nullopt;
  const auto rho = inverse_depth(*ray, z[2]);
  if (!rho || !(*rho > 0)) return std::nullopt;
  const Eigen::Vector3d point =
      free_camera::position(left) + rotation_matrix<double>(free_camera::orientation(left)) * (*ray / *rho);
  const auto prediction = predict_measurement(left, point);
  if (!prediction) return std::nullopt;
  // The prediction of the new landmark equals its measurement for any error: Hl Jv + Hv = 0, Hl Jz = I
  Initialization initialization{point, {}, prediction->Hl.inverse()};
  initialization.Jv = -initialization.Jz * prediction->Hv;
  if (!initialization.Jz.allFinite()) return std::nullopt;
  return initialization;
}

std::optional<StereoCamera::InverseDepthInitialization> StereoCamera::initialize_inverse_depth(
    const CameraState& left, const Eigen::Vector3d& z) const {
  const auto point = initialize(left, z);
  if (!point) return std::nullopt;
  const Eigen::Matrix3d axes = rotation_matrix<double>(free_camera::orientation(left));
  const double depth = axes.col(2).dot(point->landmark - free_camera::position(left));
  const auto seen_from = InverseDepthLandmark::initialize(camera, left, z.head<2>(), 1 / depth);
  if (!seen_from) return std::nullopt;
  InverseDepthInitialization initialized{{seen_from->world_from_initial_camera}, seen_from->landmark, {}, {}};
  const auto prediction = predict_measurement(left, initialized.form, initialized.landmark);
  if (!prediction) return std::nullopt;
  // The initial position is that of the camera; the rest follows from Hl Jv + Hv = 0, Hl Jz = I
  const Eigen::Matrix3d by_rest = prediction->Hl.rightCols<3>().inverse();
  initialized.Jv.setZero();
  initialized.Jv.topLeftCorner<3, 3>().setIdentity();
  initialized.Jv.bottomRows<3>() =
      -by_rest * (prediction->Hv + prediction->Hl.leftCols<3>() * initialized.Jv.topRows<3>());
  initialized.Jz << Eigen::Matrix3d::Zero(), by_rest;
  if (!initialized.Jz.allFinite()) return std::nullopt;
  return initialized;
}

}  // namespace incognita
