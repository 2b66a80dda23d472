// Frame transformations of points and poses on the plane, with Jacobians: for maps expressed in the vehicle
// frame and for planar rigid motion.
//
// A pose is x, y (m) and heading (rad); its error is additive (planar::pose_chart).
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita::planar {

Eigen::Matrix2d rotation(double heading);

/// d(error at `to`) / d(error at `from`) of any motion that is invariant to the initial pose. With the mean
/// as `from` this is F of the vehicle models; with another pose it is the first-estimate Jacobian of Huang,
/// Mourikis and Roumeliotis (ISER 2008, eq. 28).
PoseJacobian jacobian_between(const Pose<double>& from, const Pose<double>& to);

struct FramedPoint {
  Eigen::Vector2d point;
  Eigen::Matrix<double, 2, 3> by_frame;  ///< d(point) / d(pose of the frame)
  Eigen::Matrix2d by_point;
};

struct FramedPose {
  Pose<double> pose;
  PoseJacobian by_frame;
  PoseJacobian by_pose;
};

/// A point expressed in `frame`: R' (point - position).
FramedPoint in_frame(const Pose<double>& frame, const Eigen::Vector2d& point);

/// A point given in `frame`, expressed in the parent frame of `frame`: position + R point.
FramedPoint out_of_frame(const Pose<double>& frame, const Eigen::Vector2d& point);

/// A pose expressed in `frame`.
FramedPose in_frame(const Pose<double>& frame, const Pose<double>& pose);

/// The inverse pose, with its Jacobian by_frame with respect to `pose`.
FramedPose inverse(const Pose<double>& pose);

}  // namespace incognita::planar
