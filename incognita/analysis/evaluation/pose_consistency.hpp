// Whether an estimated pose is as wrong as its covariance says (Bar-Shalom et al. 2001, ch. 5.4).
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

/// truth (-) estimate in that order; NaN for the rotation where either orientation is not known.
PoseError pose_error(const StampedPose& truth, const StampedPose& estimate);

/// e' P^-1 e of some components of an error, and how many they are.
struct NormalizedSquare {
  double sum = 0;
  int degrees_of_freedom = 0;
};

/// Normalized estimation error squared of the pose. Its degrees of freedom are 6, less components whose error
/// is not known (NaN) or that are exact by construction (error and variance 0, as height, roll and pitch on a
/// plane). Where the covariance of the rest is not positive definite, and height, roll and pitch are not said
/// to be exact, as on uneven ground, which gives them, x, y and rotZ alone are taken; nothing where theirs is
/// not either: there is no such number for a pose said to be exact.
std::optional<NormalizedSquare> pose_normalized_square(const PoseError& error,
                                                       const PoseCovariance& covariance);
/// The same divided by its degrees of freedom, so that 1 is right.
std::optional<double> pose_nees(const PoseError& error, const PoseCovariance& covariance);

/// Whether a position lies beyond 3 sigma of its covariance: its Mahalanobis distance squared exceeds the
/// 0.9973 quantile of chi-square with 3 degrees of freedom, fewer on a plane or uneven ground as in
/// pose_nees(). A covariance that is not positive definite then either counts when there is an error at all.
bool beyond_three_sigma(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance);

struct MeanNees {
  double value = 0;
  std::size_t count = 0;  ///< poses behind it
};

/// Mean of pose_nees over matched poses whose covariance is known at the estimate's own time stamp; nothing
/// when there is none.
std::optional<MeanNees> mean_pose_nees(const MatchedTrajectories& matched,
                                       const std::vector<StampedCovariance>& covariances);

}  // namespace incognita
