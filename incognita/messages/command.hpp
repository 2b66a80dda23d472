// Output of the controller: for each body the input of its motion model, or an instruction to the operator who holds it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/motion/gaze_swing.hpp"

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

struct BodyCommand {
  /// In the convention of its motion model; for a free camera the accelerations of (5.24), m/s^2 in world axes and
  /// rad/s^2 in camera axes. Empty: none, a vehicle stands still and a body in space keeps its velocity.
  SmallVector input = {};
  /// True when an operator moves the body: no input is commanded and the actual input is unknown.
  bool operator_controlled = false;
  std::optional<UserCommand> shown = {};          ///< to its operator; none: come to rest
  std::optional<Eigen::Vector4d> reference = {};  ///< x, y, z (m, world) and heading (rad) to follow
};

struct Command {
  std::vector<BodyCommand> bodies;  ///< one per body, in their order; none for a body: an empty one
};

/// The command of a body; an empty one where there is none.
inline const BodyCommand& command_of(const Command& command, std::size_t body) {
  static const BodyCommand nothing;
  return body < command.bodies.size() ? command.bodies[body] : nothing;
}

/// The input of a body; zeros where none is commanded.
inline SmallVector input_of(const BodyCommand& command, Eigen::Index size) {
  return command.input.size() == 0 ? SmallVector(SmallVector::Zero(size)) : command.input;
}

}  // namespace incognita
