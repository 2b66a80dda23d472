#include "incognita/control/body_controller.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/control/fly_segment.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

constexpr double least_braking_s = 0.5;

/// False before the first decision.
bool is_set(const BodyGoal& goal) { return goal.end_t > goal.start_t; }

Segment segment_of(const BodyGoal& goal) { return {goal.from, goal.to, goal.start_t, goal.end_t}; }

/// The goal shown to the operator.
BodyCommand shown(const BodyGoal* goal) {
  BodyCommand command;
  command.operator_controlled = true;
  if (!goal || !is_set(*goal)) return command;
  command.shown = UserCommand{segment_of(*goal), goal->decided, std::nullopt};
  if (!goal->heading_rad) return command;
  command.shown->gaze = {*goal->heading_rad, goal->heading_rate_rad_s, goal->elevation_rad,
                         goal->elevation_rate_rad_s};
  command.reference = Eigen::Vector4d(goal->to.x(), goal->to.y(), goal->to.z(), *goal->heading_rad);
  return command;
}

/// The goal of the control point: on uneven ground it lies ahead of the axle.
Eigen::Vector3d control_point_at(const BodyControl& c, const BodyGoal& goal, double heading_rad) {
  const bool ahead = traits_of(c.motion).space == Space::uneven_ground &&
                     c.steering.law == ControlLaw::feedback_linearization;
  const double forward_m = ahead ? c.steering.control_point_m : 0;
  return goal.to + forward_m * Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0);
}

bool takes_speed_and_turn_rate(const AnyMotion& motion) {
  return inputs_of(motion) == 2 && !traits_of(motion).has_input("steering");
}

void check(const BodyControl& c) {
  if (c.operator_controlled && (c.carried_at || !traits_of(c.motion).in_space()))
    throw std::invalid_argument("an operator moves cameras that are free, and no other bodies");
  if ((c.carried_at || c.obstacle_avoidance) &&
      !(takes_speed_and_turn_rate(c.motion) && c.steering.most_input.size() == 2))
    throw std::invalid_argument(
        "a vehicle that carries a camera or avoids obstacles needs speed and turn rate as inputs, with limits");
  if (c.obstacle_avoidance) c.obstacle_avoidance->check();
}

}  // namespace

BodyControl free_camera_control(const ControlSettings& settings, bool operator_controlled) {
  BodyControl control{FreeCameraMotion{}, {}};
  control.steering.camera = settings;
  control.steering.input = SmallVector::Zero(FreeCameraMotion::input_size);
  control.steering.most_input.resize(FreeCameraMotion::input_size);
  control.steering.most_input.head<3>().setConstant(settings.max_acceleration_m_s2);
  control.steering.most_input.tail<3>().setConstant(settings.max_angular_acceleration_rad_s2);
  control.operator_controlled = operator_controlled;
  return control;
}

planar::Pose<double> axle_under(const CameraState& camera, const Mount& mount) {
  const Eigen::Matrix3d world_from_body =
      rotation_matrix<double>(free_camera::orientation(camera)) * mount.body_from_camera().transpose();
  const Eigen::Vector3d axle = free_camera::position(camera) - world_from_body * mount.lever();
  return {axle.x(), axle.y(), std::atan2(world_from_body(1, 0), world_from_body(0, 0))};
}

BodyController::BodyController(BodyControl control, double period_s)
    : control_(std::move(control)),
      period_s_(period_s),
      law_(make_steering(control_.motion, control_.steering, period_s)) {
  control_.steering.law = law_of(control_.motion, control_.steering.law);
  check(control_);
}

void BodyController::head_for(const BodyGoal& goal) {
  const double heading_rad = goal.heading_rad.value_or(0);
  control_.steering.path = PointPath{control_point_at(control_, goal, heading_rad), heading_rad};
  law_ = make_steering(control_.motion, control_.steering, period_s_);
}

/// Scaled to the limits of the vehicle and slowed down by obstacles.
Eigen::Vector2d BodyController::clear_of_obstacles(const Eigen::Vector2d& desired,
                                                   const BodyObservation& observed) {
  const SmallVector& most = control_.steering.most_input;
  const Eigen::Vector2d drive = limited(desired, {most[0], most[1]}).input();
  if (!control_.obstacle_avoidance) return drive;
  const AvoidanceCommand clear =
      avoid_obstacles(drive, observed.proximity_ranges, *control_.obstacle_avoidance, turn_side_);
  turn_side_ = clear.turn_side;
  return clear.drive;
}

/// The goal's gaze; without one, a swing about the first heading.
Heading BodyController::gaze_of(const BodyGoal& goal, double t) {
  if (goal.heading_rad)
    return {*goal.heading_rad, goal.heading_rate_rad_s, goal.elevation_rad, goal.elevation_rate_rad_s};
  if (!first_heading_) {
    first_heading_ = heading_of(free_camera::orientation(CameraState(last_known_)));
    first_t_ = t;
  }
  const ControlSettings& s = control_.steering.camera;
  return GazeSwing{s.gaze_amplitude_rad, s.gaze_period_s}.at(*first_heading_, t - *first_t_);
}

/// To the goal with minimum jerk: (5.29).
void BodyController::fly(const BodyGoal& goal, double t, BodyCommand& command) {
  const Heading gaze = gaze_of(goal, t);
  const SmallVector& most = control_.steering.most_input;
  const SmallVector input =
      fly_segment(CameraState(last_known_), segment_of(goal), gaze, t, control_.steering.camera);
  command.input = input.cwiseMax(-most).cwiseMin(most);
  command.reference = Eigen::Vector4d(goal.to.x(), goal.to.y(), goal.to.z(), gaze.rad);
}

/// Along the path.
void BodyController::steer(const SmallVector& state, double since_start_s, BodyCommand& command) const {
  command.input = law_->act(state, since_start_s);
  if (control_.steering.law == ControlLaw::none) return;
  const Reference r = at(control_.steering.path, since_start_s);
  command.reference = Eigen::Vector4d(r.position.x(), r.position.y(), r.position.z(), r.heading);
}

/// A person drives the body, flies it, or says what its operator is shown.
BodyCommand BodyController::by_hand(const SmallVector& state, const ManualDrive& drive,
                                    const BodyObservation& observed, double t) {
  BodyCommand command;
  if (control_.operator_controlled) {
    command.operator_controlled = true;
    command.shown = display_.show(CameraState(state), drive, t);
  } else if (flies()) {
    if (!flight_) flight_.emplace();
    const SmallVector& most = control_.steering.most_input;
    const SmallVector input = flight_->act(CameraState(state), drive, t, control_.steering.camera);
    command.input = input.cwiseMax(-most).cwiseMin(most);
    command.reference = flight_->reference();
  } else {
    command.input = manual_input(drive, control_.steering.most_input);
    if (takes_speed_and_turn_rate(control_.motion))
      command.input = clear_of_obstacles(command.input, observed);
  }
  return command;
}

BodyCommand BodyController::act(const SmallVector& state, const BodyGoal* goal,
                                const BodyObservation& observed, double t, double since_start_s) {
  if (!goal || !goal->manual) flight_.reset();
  if (goal && goal->manual) {
    lost_t_.reset();
    last_known_ = state;
    return by_hand(state, *goal->manual, observed, t);
  }
  if (control_.operator_controlled) return shown(goal);
  lost_t_.reset();
  last_known_ = state;
  BodyCommand command;
  if (goal && flies() && is_set(*goal)) {
    fly(*goal, t, command);
    return command;
  }
  if (goal && goal->drive) {
    command.input = clear_of_obstacles(*goal->drive, observed);
    return command;
  }
  if (goal && goal->decided) head_for(*goal);
  if (!control_.carried_at) {
    steer(state, since_start_s, command);
    return command;
  }
  steer(axle_under(CameraState(state), *control_.carried_at), since_start_s, command);
  command.input = clear_of_obstacles(command.input, observed);
  command.reference.reset();  // it is that of the vehicle, not of the camera
  return command;
}

/// The time to stop within the limits of the inputs.
double BodyController::braking_s() const {
  const SmallVector& most = control_.steering.most_input;
  return std::max(least_braking_s, (last_known_.tail<6>().cwiseAbs().array() / most.array()).maxCoeff());
}

BodyCommand BodyController::act_when_lost(const BodyGoal* goal, const BodyObservation& observed, double t) {
  flight_.reset();
  if (control_.operator_controlled) return shown(nullptr);
  if (goal && goal->manual && !flies()) return by_hand({}, *goal->manual, observed, t);
  if (!lost_t_) lost_t_ = t;
  BodyCommand command;
  command.input = SmallVector::Zero(inputs_of(control_.motion));
  if (!flies() || last_known_.size() == 0 || t - *lost_t_ >= braking_s()) return command;
  command.input = -last_known_.tail<6>() / braking_s();
  return command;
}

}  // namespace incognita
