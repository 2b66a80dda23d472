#include "incognita/control/camera_controller.hpp"

#include "incognita/control/fly_segment.hpp"
#include "incognita/models/heading.hpp"

namespace incognita {
namespace {

constexpr double braking_s = 0.5;

/// The goal shown to the operator; nothing while the estimate is lost.
Command shown(const Goal& goal, bool lost) {
  Command command;
  command.operator_controlled = true;
  if (lost) return command;
  UserCommand& user = command.user_commands.emplace_back();
  user.segment = {goal.from, goal.to, goal.start_t, goal.end_t};
  user.is_new = goal.decided;
  if (goal.heading_rad) user.gaze = {*goal.heading_rad, goal.heading_rate_rad_s};
  return command;
}

}  // namespace

CameraController::CameraController(const ControlSettings& settings, bool operator_controlled)
    : settings_(settings), operator_controlled_(operator_controlled) {}

Command CameraController::act(const Estimate& estimate, const Goal& goal, const Observation&,
                              const Tick& tick) {
  if (!estimate.started) return {};
  const bool lost = estimate.status.state == TrackingState::lost;
  if (operator_controlled_) return shown(goal, lost);
  if (lost) {
    if (!lost_t_) lost_t_ = tick.t;
    return brake(tick);
  }
  lost_t_.reset();
  last_known_ = estimate.camera_state();
  return fly_segment(last_known_, {goal.from, goal.to, goal.start_t, goal.end_t}, gaze_of(goal, tick), tick.t,
                     settings_);
}

/// The goal's gaze; without one, a swing about the first heading.
Heading CameraController::gaze_of(const Goal& goal, const Tick& tick) {
  if (goal.heading_rad) return {*goal.heading_rad, goal.heading_rate_rad_s};
  if (!first_heading_) {
    first_heading_ = heading_of(free_camera::orientation(last_known_));
    first_t_ = tick.t;
  }
  return GazeSwing{settings_.gaze_amplitude_rad, settings_.gaze_period_s}.at(*first_heading_,
                                                                             tick.t - *first_t_);
}

Command CameraController::brake(const Tick& tick) const {
  if (tick.t - *lost_t_ >= braking_s) return {};
  Command command;
  command.linear_acceleration = -free_camera::velocity(last_known_) / braking_s;
  command.angular_acceleration = -free_camera::angular_rate(last_known_) / braking_s;
  return command;
}

}  // namespace incognita
