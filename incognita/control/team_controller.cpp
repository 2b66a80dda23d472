#include "incognita/control/team_controller.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/control/fly_segment.hpp"

namespace incognita {

TeamController::TeamController(std::vector<VehicleSteering> vehicles, double period_s,
                               bool operator_controlled)
    : vehicles_(std::move(vehicles)), period_s_(period_s), operator_controlled_(operator_controlled) {
  for (const VehicleSteering& v : vehicles_) {
    if (operator_controlled_ && !traits_of(v.motion).in_space())
      throw std::invalid_argument("an operator moves cameras that are free, and no other vehicles");
    laws_.push_back(make_steering(v.motion, v.settings, period_s_));
  }
}

namespace {

/// Clamped to the vehicle's limits.
SmallVector driven(const VehicleSteering& v, const Eigen::Vector2d& drive) {
  const SmallVector& most = v.settings.most_input;
  return SmallVector(drive).cwiseMax(-most).cwiseMin(most);
}

/// The goal of the control point: on uneven ground it lies ahead of the axle.
Eigen::Vector3d steered_to(const VehicleSteering& v, const VehicleGoal& goal) {
  const bool ahead = traits_of(v.motion).space == Space::uneven_ground &&
                     v.settings.law == ControlLaw::feedback_linearization;
  const double forward_m = ahead ? v.settings.control_point_m : 0;
  return goal.to + forward_m * Eigen::Vector3d(std::cos(goal.heading_rad), std::sin(goal.heading_rad), 0);
}

Eigen::Vector4d reference_at(const VehicleGoal& goal) {
  return {goal.to.x(), goal.to.y(), goal.to.z(), goal.heading_rad};
}

}  // namespace

void TeamController::turn_to(const Goal& goal) {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    VehicleSteering& v = vehicles_[i];
    if (goal.team[i].drive) continue;
    v.settings.path = PointPath{steered_to(v, goal.team[i]), goal.team[i].heading_rad};
    laws_[i] = make_steering(v.motion, v.settings, period_s_);
  }
}

/// Ground vehicles stand still without a command; a body in space would drift, so it brakes from its last
/// known motion.
Command TeamController::brake(const Tick& tick) {
  constexpr double braking_s = 0.5;
  if (!lost_t_) lost_t_ = tick.t;
  Command command;
  if (tick.t - *lost_t_ >= braking_s || last_known_.size() != vehicles_.size()) return command;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const SmallVector& most = vehicles_[i].settings.most_input;
    SmallVector input = SmallVector::Zero(inputs_of(vehicles_[i].motion));
    if (traits_of(vehicles_[i].motion).in_space()) input = -last_known_[i].tail<6>() / braking_s;
    if (most.size() == input.size()) input = input.cwiseMax(-most).cwiseMin(most).eval();
    command.inputs.push_back(input);
  }
  return command;
}

/// A body in space moves to its goal with minimum jerk and the goal's gaze: (5.29).
SmallVector TeamController::fly(const Goal& goal, std::size_t i, const Tick& tick) const {
  const VehicleGoal& to = goal.team[i];
  const SteeringSettings& s = vehicles_[i].settings;
  const SmallVector wished =
      fly_segment(CameraState(last_known_[i]), {to.from, to.to, goal.start_t, goal.end_t},
                  {to.heading_rad, to.heading_rate_rad_s}, tick.t, s.camera)
          .as_input();
  return wished.cwiseMax(-s.most_input).cwiseMin(s.most_input);
}

/// The goals shown to the operators; nothing while the estimate is lost.
Command TeamController::shown(const Goal& goal, bool lost) const {
  Command command;
  command.operator_controlled = true;
  if (lost) return command;
  for (const VehicleGoal& to : goal.team) {
    command.user_commands.push_back({{to.from, to.to, goal.start_t, goal.end_t},
                                     goal.decided,
                                     Heading{to.heading_rad, to.heading_rate_rad_s}});
    command.references.push_back(reference_at(to));
  }
  return command;
}

/// Stores the estimate in last_known_; while lost, it keeps the last state, to brake from.
void TeamController::take_states(const Estimate& estimate) {
  if (estimate.status.state == TrackingState::lost) return;
  lost_t_.reset();
  last_known_.clear();
  for (const Body& v : estimate.bodies) last_known_.emplace_back(v.state);
}

Command TeamController::act(const Estimate& estimate, const Goal& goal, const Observation&,
                            const Tick& tick) {
  if (!first_t_) first_t_ = tick.t;
  if (!estimate.started) return {};
  const bool lost = estimate.status.state == TrackingState::lost;
  if (operator_controlled_) return shown(goal, lost);
  take_states(estimate);
  if (lost) return brake(tick);
  Command command;
  const bool has_goals = goal.team.size() == vehicles_.size();
  if (goal.decided && has_goals) turn_to(goal);
  const double t = tick.t - *first_t_;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (has_goals && goal.team[i].drive) {
      command.inputs.push_back(driven(vehicles_[i], *goal.team[i].drive));
      continue;
    }
    if (has_goals && traits_of(vehicles_[i].motion).in_space()) {
      command.inputs.push_back(fly(goal, i, tick));
      command.references.push_back(reference_at(goal.team[i]));
      continue;
    }
    command.inputs.push_back(laws_[i]->act(last_known_[i], t));
    if (vehicles_[i].settings.law == ControlLaw::none) continue;
    const Reference reference = at(vehicles_[i].settings.path, t);
    command.references.emplace_back(reference.position.x(), reference.position.y(), reference.position.z(),
                                    reference.heading);
  }
  return command;
}

}  // namespace incognita
