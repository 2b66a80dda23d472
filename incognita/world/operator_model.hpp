// The model of an operator: a person who holds a camera and moves it as a screen says, late, not quite as
// far, and sometimes another way. Thesis 6.3.2.
//
// An operator is an actuator. What the robot's side gives is a user command; the operator feels how the
// camera really moves, and what the hand does is the plant's input. Nothing of either reaches an estimator.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/models/free_camera.hpp"
#include "incognita/models/gaze_swing.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

/// What an operator understood of the user commands, and when.
class OperatorModel {
 public:
  /// `name`: of the random stream. Throws std::invalid_argument where a setting cannot be.
  OperatorModel(const OperatorSettings& settings, std::uint64_t seed, const std::string& name);

  /// The segment in progress at `t`. `shown`: what the screen says. An operator knows direction and length,
  /// not the place, and begins where the camera is, `at`. A later command replaces what is in progress.
  const Segment& follow(const UserCommand& shown, const Eigen::Vector3d& at, double t);

  /// Drops what was shown and not begun, and what was in progress: the screen went dark.
  void forget();

 private:
  Eigen::Vector3d understood(const Eigen::Vector3d& displacement);

  OperatorSettings settings_;
  RandomStream random_;
  std::deque<Segment> waiting_;  ///< shown, and not begun
  Segment in_progress_;
  bool started_ = false;
};

/// How a hand moves a free camera along a segment, looking level along a heading: the accelerations of (5.24)
/// from the true state.
using OperatorMotion = std::function<FreeCameraMotion::Input<double>(
    const FreeCameraMotion::State<double>& state, const Segment& segment, const Heading& gaze, double t)>;

/// An operator's hand on one camera.
class OperatorActuator {
 public:
  /// `swing`: where the operator looks while nothing says where.
  OperatorActuator(OperatorModel model, OperatorMotion motion, const GazeSwing& swing = {});

  /// The input of the camera from `t` on, in the true state of that time. Without user commands a camera in
  /// the hand comes to rest; one that was not handed over yet (`operator_controlled` false) is not touched.
  FreeCameraMotion::Input<double> move(const Command& command, std::size_t camera,
                                       const FreeCameraMotion::State<double>& state, double t);

 private:
  FreeCameraMotion::Input<double> stop(const FreeCameraMotion::State<double>& state, double t);
  Heading gaze(const UserCommand& shown, const FreeCameraMotion::State<double>& state, double t);

  struct Moment {
    FreeCameraMotion::State<double> state;
    double t;
  };
  OperatorModel model_;
  OperatorMotion motion_;
  GazeSwing swing_;
  std::optional<Moment> stopped_;      ///< when the screen went dark
  std::optional<Heading> first_gaze_;  ///< the middle of the swing
  double swing_start_t_ = 0;
};

}  // namespace incognita
