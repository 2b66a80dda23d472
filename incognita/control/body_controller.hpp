// Controls one body: along its own path, to the goal of a decision, or by showing the goal to its operator. Thesis
// (5.29) and Section 6.4.
#pragma once

#include <memory>
#include <optional>

#include "incognita/control/manual_control.hpp"
#include "incognita/control/obstacle_avoidance.hpp"
#include "incognita/control/steering.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/models/motion/mount.hpp"

namespace incognita {

class StateArchive;

/// How a body is controlled.
struct BodyControl {
  AnyMotion motion;           ///< of the body; with `carried_at`, of the vehicle that carries it
  SteeringSettings steering;  ///< law of `motion`, used where the goal does not prescribe the motion
  std::optional<Mount> carried_at = {};  ///< the body is a camera on a vehicle, which receives the input
  /// For inputs of speed and turn rate: obstacles limit every command.
  std::optional<ObstacleAvoidanceSettings> obstacle_avoidance = {};
  bool operator_controlled = false;  ///< an operator holds the body, a free camera, and is shown the goal
};

/// A free camera that is flown: (5.29) along the segments of its goals. Before the first goal it is not accelerated.
BodyControl free_camera_control(const ControlSettings& settings, bool operator_controlled = false);

/// The vehicle's planar position and heading, from its camera's state.
planar::Pose<double> axle_under(const CameraState& camera, const Mount& mount);

class BodyController {
 public:
  /// `period_s`: duration of one command. Throws std::invalid_argument as make_steering and
  /// ObstacleAvoidanceSettings do, and for an operator who holds anything but a free camera.
  BodyController(BodyControl control, double period_s);

  /// The command until the next tick. `state`: estimated, of the body. `goal`: null without one; a newly decided one
  /// replaces the path. `t`: s on the clock of the goal; `since_start_s`: s since the first tick, the time of the path.
  BodyCommand act(const SmallVector& state, const BodyGoal* goal, const BodyObservation& observed, double t,
                  double since_start_s);

  /// The command while the estimate is lost: vehicles stand still, or go where a person drives them; a body in space
  /// would drift, so it brakes from its last known motion.
  BodyCommand act_when_lost(const BodyGoal* goal, const BodyObservation& observed, double t);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  bool flies() const { return !control_.carried_at && traits_of(control_.motion).in_space(); }
  double braking_s() const;
  BodyCommand by_hand(const SmallVector& state, const ManualDrive& drive, const BodyObservation& observed,
                      double t);
  void head_for(const BodyGoal& goal);
  Eigen::Vector2d clear_of_obstacles(const Eigen::Vector2d& desired, const BodyObservation& observed);
  void fly(const BodyGoal& goal, double t, BodyCommand& command);
  void steer(const SmallVector& state, double since_start_s, BodyCommand& command) const;
  Heading gaze_of(const BodyGoal& goal, double t);

  BodyControl control_;
  double period_s_;
  std::unique_ptr<Steering> law_;
  SmallVector last_known_;  ///< state; empty before the start
  std::optional<double> lost_t_;
  std::optional<double> first_heading_, first_t_;  ///< center and start of the swing of the gaze
  TurnSide turn_side_ = TurnSide::none;
  std::optional<ManualFlight> flight_;  ///< while a person flies the body
  ManualDisplay display_;
};

}  // namespace incognita
