#include "incognita/control/team_controller.hpp"

#include <cmath>
#include <utility>

namespace incognita {

TeamController::TeamController(std::vector<VehicleSteering> vehicles, double period_s)
    : vehicles_(std::move(vehicles)), period_s_(period_s) {
  for (const VehicleSteering& v : vehicles_) laws_.push_back(make_steering(v.motion, v.settings, period_s_));
}

namespace {

/// On uneven ground it is the point before the axle that is brought to the path: to where it is at the goal.
Eigen::Vector3d steered_to(const VehicleSteering& v, const Eigen::Vector4d& goal) {
  const bool ahead =
      std::holds_alternative<TerrainVehicle>(v.motion) && v.settings.law == "feedback-linearisation";
  const double forward_m = ahead ? v.settings.control_point_m : 0;
  return goal.head<3>() + forward_m * Eigen::Vector3d(std::cos(goal[3]), std::sin(goal[3]), 0);
}

}  // namespace

void TeamController::turn_to(const Goal& goal) {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    VehicleSteering& v = vehicles_[i];
    v.settings.path = PointPath{steered_to(v, goal.team[i]), goal.team[i][3]};
    laws_[i] = make_steering(v.motion, v.settings, period_s_);
  }
}

Command TeamController::act(const TeamEstimate& estimate, const Goal& goal, const Tick& tick) {
  if (!first_t_) first_t_ = tick.t;
  Command command;
  if (!estimate.started || estimate.status.state == TrackingState::lost) return command;
  if (goal.decided && goal.team.size() == vehicles_.size()) turn_to(goal);
  const double t = tick.t - *first_t_;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    command.inputs.push_back(laws_[i]->act(estimate.belief.mean(estimate.vehicles[i].block), t));
    if (vehicles_[i].settings.law == "none") continue;
    const Reference wanted = at(vehicles_[i].settings.path, t);
    command.wanted.emplace_back(wanted.position.x(), wanted.position.y(), wanted.position.z(),
                                wanted.heading);
  }
  return command;
}

}  // namespace incognita
