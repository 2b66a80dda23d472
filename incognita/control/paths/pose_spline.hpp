// Natural cubic spline through poses at given times.
//
// Its acceleration is continuous, as needed for feedforward, and zero at both ends. Boost 1.74 interpolates
// uneven times only with continuous velocity (makima, pchip), and Eigen's splines solve a dense system. The
// spline may overshoot between distant samples.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Columns are samples, rows x, y, z (m) and heading (rad, not wrapped).
struct PoseSpline {
  Eigen::VectorXd t;  ///< s, strictly increasing, at least two
  Eigen::Matrix4Xd pose;
  Eigen::Matrix4Xd bending;  ///< second derivatives at the samples
};

/// Throws std::invalid_argument unless there are at least two finite samples at strictly increasing times.
PoseSpline pose_spline(const Eigen::VectorXd& t, const Eigen::Matrix4Xd& pose);

struct PoseMotion {
  Eigen::Vector4d pose;
  Eigen::Vector4d rate;
  Eigen::Vector4d acceleration;
};

/// Evaluates the spline; times outside of it are clamped to its ends.
PoseMotion at(const PoseSpline& spline, double t);

}  // namespace incognita
