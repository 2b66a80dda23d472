// Consistency of an estimated pose with its covariance: NEES (Bar-Shalom et al. 2001, ch. 5.4).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Order x y z rotX rotY rotZ: position in the world (m), right rotation error in body axes (rad), so that
/// orientation_true = orientation * exp(rot/2).
using PoseCovariance = Eigen::Matrix<double, 6, 6>;
using PoseError = Eigen::Matrix<double, 6, 1>;

struct StampedCovariance {
  double t = 0;  ///< s
  PoseCovariance covariance = PoseCovariance::Zero();
};

/// truth (-) estimate in that order; the rotation is NaN if either orientation is unknown.
PoseError pose_error(const StampedPose& truth, const StampedPose& estimate);

/// e' P^-1 e of some components of an error, and their number.
struct NormalizedSquare {
  double sum = 0;
  int degrees_of_freedom = 0;
};

/// Normalized estimation error squared (NEES) of the pose. Its degrees of freedom are 6, less components
/// whose error is unknown (NaN) or which are exact by construction (error and variance 0, as height, roll and
/// pitch on a plane). If the covariance of the rest is not positive definite and height, roll and pitch are
/// not exact, as on uneven ground, which determines them, only x, y and rotZ are used. Empty if their
/// covariance is not positive definite either: the NEES of a pose without uncertainty is undefined.
std::optional<NormalizedSquare> pose_normalized_square(const PoseError& error,
                                                       const PoseCovariance& covariance);
/// NEES divided by its degrees of freedom: 1 if consistent.
std::optional<double> pose_nees(const PoseError& error, const PoseCovariance& covariance);

/// Whether a position error lies beyond 3 sigma of its covariance: its squared Mahalanobis distance exceeds
/// the 0.9973 quantile of chi-square with 3 degrees of freedom, fewer on a plane or uneven ground as in
/// pose_nees(). If the covariance is not positive definite then either, any error counts.
bool beyond_three_sigma(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance);

struct MeanNees {
  double value = 0;
  std::size_t count = 0;  ///< number of poses
};

/// Mean of pose_nees over matched poses with a covariance at the estimate's time stamp; empty if there is none.
std::optional<MeanNees> mean_pose_nees(const MatchedTrajectories& matched,
                                       const std::vector<StampedCovariance>& covariances);

}  // namespace incognita
