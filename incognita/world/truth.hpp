// What really happens. It goes to the sensors and to the record, never to the estimator.
#pragma once

#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/free_camera.hpp"
#include "incognita/models/rigid_pose.hpp"

namespace incognita {

struct Truth {
  FreeCameraMotion::State<double> camera = FreeCameraMotion::State<double>::Zero();  ///< (5.24), world z up
  bool orientation_known = true;  ///< GPS tells a position alone
  std::vector<SmallVector> vehicles =
      {};  ///< of a team: each one's state, `camera` being the pose of the first
  std::vector<SmallVector> inputs =
      {};  ///< of a team: what each carried out since the tick before; 0 by hand
  std::vector<Eigen::Vector2d> wheels = {};  ///< of a team of carried cameras: m/s and rad/s of each carrier
  /// Of a team: each one's body in space, where it is known. A recording may know that of some vehicles only;
  /// without that of the first, `camera` means nothing.
  std::vector<std::optional<RigidPose>> poses = {};
};

}  // namespace incognita
