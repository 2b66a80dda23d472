#include "incognita/app/loop/robot_controller.hpp"

#include <algorithm>
#include <utility>

#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita {
namespace {

constexpr double most_periods = 3;  // of acceleration at once

bool is_driven_by_hand(const Goal& goal) {
  return !goal.bodies.empty() && goal.bodies.front().manual.has_value();
}

}  // namespace

RobotController::RobotController(std::unique_ptr<Controller> controller, std::shared_ptr<RobotLink> link,
                                 const VelocityLimits& limits, const CommandPace& pace,
                                 const RecoveryTurnSettings& recovery,
                                 std::function<std::chrono::steady_clock::time_point()> now)
    : controller_(std::move(controller)),
      link_(std::move(link)),
      limits_(limits),
      pace_(pace),
      recovery_(recovery),
      now_(std::move(now)) {
  limits_.check();
}

std::optional<Eigen::Vector2d> RobotController::wanted(const Command& command, const Estimate& estimate,
                                                       const Goal& goal, const Observation& observation,
                                                       double dt_s) {
  if (link_->is_stopped() || !estimate.started || !image_of(body_of(observation, 0))) return std::nullopt;
  if (is_lost(estimate, 0) && !is_driven_by_hand(goal)) {
    const double rate = recovery_.rate(dt_s);
    if (rate == 0) return std::nullopt;
    return Eigen::Vector2d(0, rate);
  }
  const Eigen::Vector2d velocity = input_of(command_of(command, 0), 2).head<2>();
  recovery_.drove(velocity.y());
  return velocity;
}

Command RobotController::act(const Estimate& estimate, const Goal& goal, const Observation& observation,
                             const Tick& tick) {
  Command command = controller_->act(estimate, goal, observation, tick);
  const auto now = now_();
  if (!driven_ || now - *driven_ > std::chrono::duration<double>(pace_.late_s)) last_.setZero();
  const double dt_s = std::min(tick.dt, most_periods * pace_.period_s);
  Eigen::Vector2d velocity(0, 0);
  if (const auto desired = wanted(command, estimate, goal, observation, dt_s))
    velocity = limited_velocity(*desired, last_, dt_s, limits_);
  link_->drive(velocity);
  last_ = velocity;
  driven_ = now;
  if (!command.bodies.empty()) command.bodies.front().input = velocity;
  return command;
}

void RobotController::state(StateArchive& archive) {
  controller_->state(archive);
  recovery_.state(archive);
  if (archive.restores()) last_.setZero();
}

}  // namespace incognita
