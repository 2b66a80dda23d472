// Pose of a rigid body in space.
#pragma once

#include <Eigen/Core>

#include "incognita/math/quaternion.hpp"

namespace incognita {

/// Error (6): position (m, world), right rotation error (rad, body axes), as the first six of a free camera.
struct RigidPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world
  Eigen::Vector4d world_from_body{1, 0, 0, 0};
};

/// A body pose computed from a state with `errors` errors. J times d(state)/dt is the velocity: that of the
/// position in the world (m/s), then the angular rate in body axes (rad/s).
template <int errors>
struct PoseOf {
  RigidPose pose;
  Eigen::Matrix<double, 6, errors> J;  ///< d(pose error) / d(state error)
};

/// A body on the x axis; its state begins with its position, m.
template <int errors>
PoseOf<errors> pose_on_line(double x) {
  PoseOf<errors> out{{{x, 0, 0}, {1, 0, 0, 0}}, Eigen::Matrix<double, 6, errors>::Zero()};
  out.J(0, 0) = 1;
  return out;
}

/// A body on the floor z = 0; its state begins with x, y (m) and heading (rad).
template <int errors>
PoseOf<errors> pose_on_floor(double x, double y, double heading) {
  PoseOf<errors> out{{{x, y, 0}, quaternion_exp<double>(Vector3<double>(0, 0, heading))},
                     Eigen::Matrix<double, 6, errors>::Zero()};
  out.J(0, 0) = out.J(1, 1) = out.J(5, 2) = 1;
  return out;
}

/// A body in space; its state begins with its position (m) and orientation (w,x,y,z).
template <int errors>
PoseOf<errors> pose_in_space(const Eigen::Vector3d& position, const Eigen::Vector4d& world_from_body) {
  return {{position, world_from_body}, Eigen::Matrix<double, 6, errors>::Identity()};
}

}  // namespace incognita
