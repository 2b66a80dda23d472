#include "incognita/models/motion/planar_frame.hpp"

#include "incognita/math/angles.hpp"

namespace incognita::planar {

Eigen::Matrix2d rotation(double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

PoseJacobian jacobian_between(const Pose<double>& from, const Pose<double>& to) {
  PoseJacobian F = PoseJacobian::Identity();
  F(0, 2) = -(to[1] - from[1]);
  F(1, 2) = to[0] - from[0];
  return F;
}

FramedPoint in_frame(const Pose<double>& frame, const Eigen::Vector2d& point) {
  const Eigen::Matrix2d Rt = rotation(frame[2]).transpose();
  FramedPoint out{Rt * (point - frame.head<2>()), {}, Rt};
  out.by_frame << -Rt, Eigen::Vector2d(out.point.y(), -out.point.x());
  return out;
}

FramedPoint out_of_frame(const Pose<double>& frame, const Eigen::Vector2d& point) {
  const Eigen::Matrix2d R = rotation(frame[2]);
  const Eigen::Vector2d turned = R * point;
  FramedPoint out{frame.head<2>() + turned, {}, R};
  out.by_frame << Eigen::Matrix2d::Identity(), Eigen::Vector2d(-turned.y(), turned.x());
  return out;
}

FramedPose in_frame(const Pose<double>& frame, const Pose<double>& pose) {
  const FramedPoint at = in_frame(frame, Eigen::Vector2d(pose.head<2>()));
  FramedPose out{{at.point.x(), at.point.y(), wrap_angle(pose[2] - frame[2])},
                 PoseJacobian::Zero(),
                 PoseJacobian::Identity()};
  out.by_frame.topRows<2>() = at.by_frame;
  out.by_frame(2, 2) = -1;
  out.by_pose.topLeftCorner<2, 2>() = at.by_point;
  return out;
}

FramedPose inverse(const Pose<double>& pose) { return in_frame(pose, Pose<double>(Pose<double>::Zero())); }

}  // namespace incognita::planar
