// Model of an operator: a person who holds a camera and moves it as shown on a screen, with a delay, an
// inexact length, and sometimes in a wrong direction. Thesis 6.3.2.
//
// The operator is an actuator: it receives user commands, knows the true motion of the camera, and its
// accelerations are the plant's input. Neither reaches the estimator.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/motion/gaze_swing.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

class StateArchive;

/// The user commands as the operator understood them, with their delay and errors.
class OperatorModel {
 public:
  /// `name`: of the random stream. Throws std::invalid_argument for invalid settings.
  OperatorModel(const OperatorSettings& settings, std::uint64_t seed, const std::string& name);

  /// The segment in progress at `t`, s. `shown`: the user command on the screen. The operator knows its
  /// direction and length, not its absolute position, and starts at the camera's position `at`. A later
  /// command replaces the one in progress.
  const Segment& follow(const UserCommand& shown, const Eigen::Vector3d& at, double t);

  /// Drops pending commands and the one in progress, as when the screen goes dark.
  void forget();

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  Eigen::Vector3d understood(const Eigen::Vector3d& displacement);

  OperatorSettings settings_;
  RandomStream random_;
  std::deque<Segment> waiting_;  ///< shown, but not yet begun
  Segment in_progress_;
  bool started_ = false;
};

/// Motion of a free camera along a segment with a level gaze: maps the true state to the accelerations of (5.24).
using OperatorMotion = std::function<FreeCameraMotion::Input<double>(
    const FreeCameraMotion::State<double>& state, const Segment& segment, const Heading& gaze, double t)>;

/// Moves one camera by hand.
class OperatorActuator {
 public:
  /// `swing`: the gaze if the user command contains none.
  OperatorActuator(OperatorModel model, OperatorMotion motion, const GazeSwing& swing = {});

  /// Input of the camera from time `t` on, given the true state at that time. Without user commands the
  /// camera is brought to rest; before it is handed over (`operator_controlled` false) the input is 0.
  FreeCameraMotion::Input<double> move(const BodyCommand& command,
                                       const FreeCameraMotion::State<double>& state, double t);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  FreeCameraMotion::Input<double> stop(const FreeCameraMotion::State<double>& state, double t);
  Heading gaze(const UserCommand& shown, const FreeCameraMotion::State<double>& state, double t);

  struct Moment {
    FreeCameraMotion::State<double> camera;
    double t;
    void state(StateArchive& archive);
  };
  OperatorModel model_;
  OperatorMotion motion_;
  GazeSwing swing_;
  std::optional<Moment> stopped_;      ///< state when the screen went dark
  std::optional<Heading> first_gaze_;  ///< center of the swing
  double swing_start_t_ = 0;
};

}  // namespace incognita
