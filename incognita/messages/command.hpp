// What the controller asks of the camera or robot, the input of thesis (5.24), or of the operator who holds
// it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/gaze_swing.hpp"

namespace incognita {

/// From where to where, world, m, and when, s.
struct Segment {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  double start_t = 0, end_t = 0;
};

/// What a screen shows an operator who holds a camera.
struct UserCommand {
  Segment segment;
  bool is_new = false;          ///< whether it was decided in this very tick
  std::optional<Heading> gaze;  ///< where to look; none: as the operator likes
};

struct Command {
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();   ///< m/s^2, world axes
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  ///< rad/s^2, camera axes

  /// An operator moves the camera: no input is asked for, and none is known
  bool operator_controlled = false;
  /// Of each camera that is moved by hand; none: come to rest
  std::vector<UserCommand> user_commands = {};

  /// Of a team: each vehicle's, as its motion model takes it; none: stand still
  std::vector<SmallVector> inputs = {};
  /// Of a team: x, y, z (m, world) and heading (rad) where each is to be now; none where it follows nothing
  std::vector<Eigen::Vector4d> references = {};

  Eigen::Matrix<double, 6, 1> as_input() const {
    Eigen::Matrix<double, 6, 1> u;
    u << linear_acceleration, angular_acceleration;
    return u;
  }
};

}  // namespace incognita
