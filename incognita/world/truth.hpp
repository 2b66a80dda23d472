// True state of the simulation or recording. Only sensors and the recorder receive it, not the estimator.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/motion/rigid_pose.hpp"

namespace incognita {

/// What is known of one body; a recording may lack any of it.
struct BodyTruth {
  std::optional<RigidPose> pose = {};  ///< world from body
  bool orientation_known = true;       ///< false for GPS, which measures only position
  SmallVector state = {};              ///< of its motion model
  SmallVector input = {};              ///< executed since the last tick; zeros where an operator moves it
  SmallVector carrier = {};            ///< a carried camera: state of the vehicle that carries it
  std::optional<Eigen::Vector2d> wheels = {};  ///< and the vehicle's speed, m/s, and turn rate, rad/s
};

struct Truth {
  std::vector<BodyTruth> bodies;  ///< one per body, in their order
};

}  // namespace incognita
