// Where a body is in space and which way it is turned.
#pragma once

#include <Eigen/Core>

#include "incognita/math/quaternion.hpp"

namespace incognita {

/// Error (6): position (m, world), right rotation error (rad, body axes), as the first six of a free camera.
struct RigidPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world
  Eigen::Vector4d world_from_body{1, 0, 0, 0};
};

/// A pose made from a state with `errors` errors. J times the rate of a state is the velocity: that of the
/// position in the world (m/s), then the angular rate in body axes (rad/s).
template <int errors>
struct PoseOf {
  RigidPose pose;
  Eigen::Matrix<double, 6, errors> J;  ///< d(pose error) / d(state error)
};

}  // namespace incognita
