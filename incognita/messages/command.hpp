// Output of the controller: the input of thesis (5.24), or an instruction to the operator who holds the camera.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/gaze_swing.hpp"

namespace incognita {

/// A straight segment in world coordinates, m, with start and end times, s.
struct Segment {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  double start_t = 0, end_t = 0;
};

/// The instruction that a display shows to an operator who holds a camera.
struct UserCommand {
  Segment segment;
  bool is_new = false;          ///< decided in this tick
  std::optional<Heading> gaze;  ///< viewing direction; none: the operator's choice
};

struct Command {
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();   ///< m/s^2, world axes
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  ///< rad/s^2, camera axes

  /// True when an operator moves the camera: no input is commanded and the actual input is unknown.
  bool operator_controlled = false;
  /// One per hand-held camera; none: come to rest.
  std::vector<UserCommand> user_commands = {};

  /// Team: one input per vehicle, in the convention of its motion model; none: stand still.
  std::vector<SmallVector> inputs = {};
  /// Team: reference x, y, z (m, world) and heading (rad) per vehicle; empty without a trajectory to follow.
  std::vector<Eigen::Vector4d> references = {};

  Eigen::Matrix<double, 6, 1> as_input() const {
    Eigen::Matrix<double, 6, 1> u;
    u << linear_acceleration, angular_acceleration;
    return u;
  }
};

}  // namespace incognita
