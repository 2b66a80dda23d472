// A smooth way through poses at given times: the natural cubic spline.
//
// Its acceleration is continuous, which a controller that feeds it forward wants, and zero at both ends.
// Boost 1.74 interpolates uneven times with continuous velocity only (makima, pchip), and Eigen's splines
// solve a dense system. Between far-apart samples it may swing out; sample where it matters.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Columns are samples, rows x, y, z (m) and heading (rad, not wrapped).
struct PoseSpline {
  Eigen::VectorXd t;  ///< s, rising, two or more
  Eigen::Matrix4Xd pose;
  Eigen::Matrix4Xd bending;  ///< second derivatives at the samples
};

/// Throws std::invalid_argument unless there are two finite samples or more at rising times.
PoseSpline pose_spline(const Eigen::VectorXd& t, const Eigen::Matrix4Xd& pose);

struct PoseMotion {
  Eigen::Vector4d pose;
  Eigen::Vector4d rate;
  Eigen::Vector4d acceleration;
};

/// At a time from the first sample's to the last's; others are moved to the nearer end.
PoseMotion at(const PoseSpline& spline, double t);

}  // namespace incognita
