#include "incognita/control/team_controller.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "incognita/control/track_reference.hpp"
#include "incognita/models/heading.hpp"

namespace incognita {

TeamController::TeamController(std::vector<VehicleSteering> vehicles, double period_s,
                               const PersonSettings& person, std::uint64_t seed)
    : vehicles_(std::move(vehicles)), period_s_(period_s) {
  for (const VehicleSteering& v : vehicles_) {
    laws_.push_back(make_steering(v.motion, v.settings, period_s_));
    if (person.holds) persons_.emplace_back(person, seed, "person." + std::to_string(persons_.size()));
  }
}

namespace {

/// Within what the vehicle can do.
SmallVector driven(const VehicleSteering& v, const Eigen::Vector2d& drive) {
  const SmallVector& most = v.settings.most_input;
  return SmallVector(drive).cwiseMax(-most).cwiseMin(most);
}

/// On uneven ground it is the point before the axle that is brought to the path: to where it is at the goal.
Eigen::Vector3d steered_to(const VehicleSteering& v, const VehicleGoal& goal) {
  const bool ahead =
      std::holds_alternative<TerrainVehicle>(v.motion) && v.settings.law == "feedback-linearisation";
  const double forward_m = ahead ? v.settings.control_point_m : 0;
  return goal.to + forward_m * Eigen::Vector3d(std::cos(goal.heading_rad), std::sin(goal.heading_rad), 0);
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

/// Vehicles stand still without a command; a body in space goes on, so it brakes from its last known motion.
Command TeamController::brake(const Tick& tick) {
  constexpr double braking_s = 0.5;
  if (!lost_t_) lost_t_ = tick.t;
  for (Person& person : persons_) person.forget();
  Command command;
  command.by_hand = !persons_.empty();
  if (tick.t - *lost_t_ >= braking_s || last_known_.size() != vehicles_.size()) return command;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const SmallVector& most = vehicles_[i].settings.most_input;
    SmallVector input = SmallVector::Zero(inputs_of(vehicles_[i].motion));
    if (std::holds_alternative<FreeCameraMotion>(vehicles_[i].motion))
      input = -last_known_[i].tail<6>() / braking_s;
    if (most.size() == input.size()) input = input.cwiseMax(-most).cwiseMin(most).eval();
    command.inputs.push_back(input);
  }
  return command;
}

/// A body in space goes to its goal with the least jerk, looking where the goal says: (5.29).
SmallVector TeamController::fly(const Goal& goal, std::size_t i, const Tick& tick) {
  const VehicleGoal& to = goal.team[i];
  const SmallVector& state = last_known_[i];
  Way way{to.from, to.to, goal.start_t, goal.end_t};
  if (!persons_.empty()) way = persons_[i].obey(way, goal.decided, state.head<3>(), tick.t);
  const Reference r = minimum_jerk(way.from, way.to, way.start_t, way.end_t, tick.t);
  const Eigen::Vector3d rate(0, -to.heading_rate_rad_s, 0);  // left about z is about -y of the camera
  const SteeringSettings& s = vehicles_[i].settings;
  const SmallVector wished = track_reference(CameraState(state), r.position, r.velocity, r.acceleration,
                                             level_gaze(to.heading_rad), rate, s.camera)
                                 .as_input();
  return wished.cwiseMax(-s.most_input).cwiseMin(s.most_input);
}

/// last_known_ <- what is steered by; once lost, it stays what it was, to brake from.
void TeamController::take_states(const TeamEstimate& estimate, const Observation& seen) {
  if (lost_t_) return;
  if (!persons_.empty() && seen.felt.size() == vehicles_.size()) {
    last_known_ = seen.felt;
  } else if (estimate.status.state != TrackingState::lost) {
    last_known_.clear();
    for (const TeamVehicle& v : estimate.vehicles) last_known_.emplace_back(estimate.belief.mean(v.block));
  }
}

Command TeamController::act(const TeamEstimate& estimate, const Goal& goal, const Observation& seen,
                            const Tick& tick) {
  if (!first_t_) first_t_ = tick.t;
  Command command;
  command.by_hand = !persons_.empty();
  if (!estimate.started) return command;
  if (estimate.status.state != TrackingState::lost) lost_t_.reset();
  take_states(estimate, seen);
  if (estimate.status.state == TrackingState::lost) return brake(tick);
  const bool has_goals = goal.team.size() == vehicles_.size();
  if (goal.decided && has_goals) turn_to(goal);
  const double t = tick.t - *first_t_;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (has_goals && goal.team[i].drive) {
      command.inputs.push_back(driven(vehicles_[i], *goal.team[i].drive));
      continue;
    }
    if (has_goals && std::holds_alternative<FreeCameraMotion>(vehicles_[i].motion)) {
      command.inputs.push_back(fly(goal, i, tick));
      const Eigen::Vector3d& to = goal.team[i].to;
      command.wanted.emplace_back(to.x(), to.y(), to.z(), goal.team[i].heading_rad);
      continue;
    }
    command.inputs.push_back(laws_[i]->act(last_known_[i], t));
    if (vehicles_[i].settings.law == "none") continue;
    const Reference wanted = at(vehicles_[i].settings.path, t);
    command.wanted.emplace_back(wanted.position.x(), wanted.position.y(), wanted.position.z(),
                                wanted.heading);
  }
  return command;
}

}  // namespace incognita
