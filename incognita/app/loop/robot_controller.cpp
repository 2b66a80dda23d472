#include "incognita/app/loop/robot_controller.hpp"

#include <algorithm>
#include <utility>

#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita {
namespace {

constexpr double most_periods = 3;  // of acceleration at once

/// Whether the robot must stand still, whatever is commanded.
bool must_stand(const Estimate& estimate, const Goal& goal, const Observation& observation) {
  if (!image_of(body_of(observation, 0))) return true;
  const bool by_hand = !goal.bodies.empty() && goal.bodies.front().manual.has_value();
  return !estimate.started || (is_lost(estimate, 0) && !by_hand);
}

}  // namespace

RobotController::RobotController(std::unique_ptr<Controller> controller, std::shared_ptr<RobotLink> link,
                                 const VelocityLimits& limits, const CommandPace& pace,
                                 std::function<std::chrono::steady_clock::time_point()> now)
    : controller_(std::move(controller)),
      link_(std::move(link)),
      limits_(limits),
      pace_(pace),
      now_(std::move(now)) {
  limits_.check();
}

Command RobotController::act(const Estimate& estimate, const Goal& goal, const Observation& observation,
                             const Tick& tick) {
  Command command = controller_->act(estimate, goal, observation, tick);
  const auto now = now_();
  if (!driven_ || now - *driven_ > std::chrono::duration<double>(pace_.late_s)) last_.setZero();
  const double dt_s = std::min(tick.dt, most_periods * pace_.period_s);
  Eigen::Vector2d velocity(0, 0);
  if (!link_->is_stopped() && !must_stand(estimate, goal, observation))
    velocity = limited_velocity(input_of(command_of(command, 0), 2).head<2>(), last_, dt_s, limits_);
  link_->drive(velocity);
  last_ = velocity;
  driven_ = now;
  if (!command.bodies.empty()) command.bodies.front().input = velocity;
  return command;
}

void RobotController::state(StateArchive& archive) {
  controller_->state(archive);
  if (archive.restores()) last_.setZero();
}

}  // namespace incognita
