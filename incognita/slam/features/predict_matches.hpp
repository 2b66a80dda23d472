// Prediction of visible landmarks: pixel, innovation covariance and warped appearance.
#pragma once

#include "incognita/slam/features/feature.hpp"

namespace incognita {

/// Approximate position of a landmark; not for rays. An inverse depth near or below zero is replaced by a
/// depth of 100 m.
Eigen::Vector3d nominal_position(const Landmark& landmark, const AnyBelief& belief);

/// predict_match() without the appearance, as needed for planned measurements.
std::optional<FeatureMatch> predict_pixel(const Landmark& landmark, const AnyBelief& belief,
                                          const Camera& camera, const CameraState& from,
                                          const CameraSlamSettings& settings);

/// The predicted measurement of one landmark from a camera state; `view`: its appearance. Nothing when it is not
/// visible: behind the camera, outside the image, or too different from its initial view for a match (thesis C.4).
/// The innovation covariance is not filled: see predict_matches().
std::optional<FeatureMatch> predict_match(const Landmark& landmark, const PatchView& view,
                                          const AnyBelief& belief, const Camera& camera,
                                          const CameraState& from, const CameraSlamSettings& settings);

/// Variance of the white part of the error of a match, per axis, px^2.
double match_var(const FeatureMatch& match, const TrackedCamera& camera);
/// Covariance of all of its error, px^2.
Eigen::Matrix2d match_cov(const FeatureMatch& match, const TrackedCamera& camera);

/// The linearized measurement, two rows, with zero residual before a match; blocks of the body, of the
/// landmark and, where it has one, of its lasting error.
LinearizedMeasurement linearized_measurement(const FeatureMatch& match, const Landmark& landmark,
                                             const TrackedCamera& camera);

/// Predicts a match anew at the current means, seen from `from`: predicted pixel and Jacobians. False where it is not defined.
bool predict_again(FeatureMatch& match, const Estimate& estimate, const TrackedCamera& camera,
                   const CameraState& from);

/// The same measurement linearized at the current means; without parts where it is not defined.
LinearizedMeasurement relinearized_measurement(const FeatureMatch& match, const Estimate& estimate,
                                               const TrackedCamera& camera);

/// Predicts all visible features of the camera at its current viewpoint, with innovation covariances.
void predict_matches(const Estimate& estimate, TrackedCamera& camera);

/// The 2x2 map from pixels of a view to pixels of the patch's own view, for the plane through `point` with
/// the given unit normal (both world). Nothing when the plane is seen from behind or edge on.
std::optional<Eigen::Matrix2d> local_warp(const PatchView& view, const Eigen::Vector3d& normal,
                                          const Eigen::Vector3d& point, const Eigen::Vector2d& pixel,
                                          const Camera& camera, const CameraState& from);

}  // namespace incognita
