// True state of the simulation or recording. Only sensors and the recorder receive it, not the estimator.
#pragma once

#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/free_camera.hpp"
#include "incognita/models/rigid_pose.hpp"

namespace incognita {

struct Truth {
  FreeCameraMotion::State<double> camera = FreeCameraMotion::State<double>::Zero();  ///< (5.24), world z up
  bool orientation_known = true;  ///< false for GPS, which measures only position
  /// Of a team: one state per vehicle; `camera` is the pose of the first.
  std::vector<SmallVector> vehicles = {};
  std::vector<SmallVector> inputs = {};      ///< team: inputs executed since the last tick; 0 for operators
  std::vector<Eigen::Vector2d> wheels = {};  ///< carried cameras: m/s and rad/s of each carrier
  /// Poses of a team's bodies in space. A recording may contain only some of them; without the first one,
  /// `camera` is undefined.
  std::vector<std::optional<RigidPose>> poses = {};
};

}  // namespace incognita
