// Frame transformations of points and poses on the plane, with Jacobians: for maps expressed in the vehicle
// frame and for planar rigid motion.
//
// A pose is x, y (m) and heading (rad); its error is additive (planar::pose_chart).
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita::planar {

inline Eigen::Matrix2d rotation(double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

/// d(error at `to`) / d(error at `from`) of any motion that is invariant to the initial pose. With the mean
/// as `from` this is F of the vehicle models; with another pose it is the first-estimate Jacobian of Huang,
/// Mourikis and Roumeliotis (ISER 2008, eq. 28).
inline PoseJacobian jacobian_between(const Pose<double>& from, const Pose<double>& to) {
  PoseJacobian F = PoseJacobian::Identity();
  F(0, 2) = -(to[1] - from[1]);
  F(1, 2) = to[0] - from[0];
  return F;
}

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
inline FramedPoint in_frame(const Pose<double>& frame, const Eigen::Vector2d& point) {
  const Eigen::Matrix2d Rt = rotation(frame[2]).transpose();
  FramedPoint out{Rt * (point - frame.head<2>()), {}, Rt};
  out.by_frame << -Rt, Eigen::Vector2d(out.point.y(), -out.point.x());
  return out;
}

/// A point given in `frame`, expressed in the parent frame of `frame`: position + R point.
inline FramedPoint out_of_frame(const Pose<double>& frame, const Eigen::Vector2d& point) {
  const Eigen::Matrix2d R = rotation(frame[2]);
  const Eigen::Vector2d turned = R * point;
  FramedPoint out{frame.head<2>() + turned, {}, R};
  out.by_frame << Eigen::Matrix2d::Identity(), Eigen::Vector2d(-turned.y(), turned.x());
  return out;
}

/// A pose expressed in `frame`.
inline FramedPose in_frame(const Pose<double>& frame, const Pose<double>& pose) {
  const FramedPoint at = in_frame(frame, Eigen::Vector2d(pose.head<2>()));
  FramedPose out{{at.point.x(), at.point.y(), wrap_angle(pose[2] - frame[2])},
                 PoseJacobian::Zero(),
                 PoseJacobian::Identity()};
  out.by_frame.topRows<2>() = at.by_frame;
  out.by_frame(2, 2) = -1;
  out.by_pose.topLeftCorner<2, 2>() = at.by_point;
  return out;
}

/// The inverse pose, with its Jacobian by_frame with respect to `pose`.
inline FramedPose inverse(const Pose<double>& pose) {
  return in_frame(pose, Pose<double>(Pose<double>::Zero()));
}

}  // namespace incognita::planar
