#include "incognita/decision/team_decision.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "incognita/decision/extended_entropy.hpp"
#include "incognita/decision/ground_actions.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {

TeamDecision::TeamDecision(EstimatorSettings team, const TeamDecisionSettings& settings)
    : team_(std::move(team)),
      settings_(settings),
      exploration_(settings.exploration, settings.seed),
      expectation_(team_, settings.max_measurements) {
  if (team_.filter.map_frame == MapFrame::vehicle)
    throw std::invalid_argument(
        "estimator.map_frame = `vehicle`: information gain is predicted in the world frame; take `world`");
  const DecisionSettings& d = settings_.decision;
  for (const BodyModel& member : team_.bodies) {
    if (settings_.carrier) {
      carried_.emplace_back(d, *settings_.carrier, member.input_sigmas[0], member.input_sigmas[3],
                            settings_.seed, carried_.size());
      continue;
    }
    if (traits_of(member.motion).in_space()) {
      if (d.gaze == DecisionSettings::Gaze::swing)
        throw std::invalid_argument(
            "decision.gaze: `swing` is of a camera in the rendered room; take `hold`");
      in_space_.emplace_back(d, member.input_sigmas[0], member.input_sigmas[3], settings_.seed,
                             in_space_.size());
      continue;
    }
    auto action_set = std::make_unique<GroundActions>(
        member, translations_of(d), d.period_s, settings_.tick_s, WorldBounds{d.min_bound_m, d.max_bound_m});
    on_ground_.emplace_back(d, names_of(action_set->actions()), settings_.seed,
                            traits_of(member.motion).position_size, on_ground_.size());
    action_set_.push_back(std::move(action_set));
  }
  names_ = !carried_.empty()    ? carried_.front().names()
           : !in_space_.empty() ? in_space_.front().names()
                                : on_ground_.front().names();
}

void TeamDecision::explore(const Estimate& e, const Tick& tick) {
  if (exploration_.settings().expected_landmarks == 0) return;
  const double share = tick.dt / static_cast<double>(e.bodies.size());
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    const SmallVector state = e.belief.mean(e.bodies[i].block);
    expectation_.prepare(e, i, exploration_.expected(), exploration_.settings().variance_expected_m2);
    exploration_.update(
        [&](const Eigen::Vector3d& position) { return expectation_.in_view(state, position); }, share,
        e.mapped_count());
  }
  goal_.coverage = exploration_.coverage();
}

void TeamDecision::choose_in_space(const Estimate& e, const Tick& tick) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    expectation_.prepare(e, i, exploration_.expected(), exploration_.settings().variance_expected_m2);
    const CameraState camera = e.belief.mean(e.bodies[i].block);
    Goal own;
    in_space_[i].choose(e.belief, e.bodies[i].block, camera, expectation_, tick, own);
    VehicleGoal& goal = goal_.team[i];
    if (own.decided) {
      goal.from = own.from;
      goal.to = own.to;
      goal.heading_rad = heading_by(team_.bodies[i].motion, e.belief.mean(e.bodies[i].block));
    }
    if (own.heading_rad)
      goal.heading_rad = *own.heading_rad, goal.heading_rate_rad_s = own.heading_rate_rad_s;
    if (i == 0) share_goal(own);
  }
}

/// Copies the first vehicle's goal to the team-wide fields.
void TeamDecision::share_goal(const Goal& first) {
  goal_.scores = first.scores;
  goal_.chosen = first.chosen;
  goal_.decided = first.decided;
  if (!first.decided) return;
  goal_.from = first.from;
  goal_.to = first.to;
  goal_.start_t = first.start_t;
  goal_.end_t = first.end_t;
}

void TeamDecision::choose_for_carrier(const Estimate& e, const Tick& tick) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    expectation_.prepare(e, i, exploration_.expected(), exploration_.settings().variance_expected_m2);
    const Body& vehicle = e.bodies[i];
    const CameraState camera = e.belief.mean(vehicle.block);
    Goal own;
    carried_[i].choose(e.belief, vehicle.block, camera, vehicle.wheels, expectation_, tick, own);
    goal_.team[i].drive = own.drive;
    if (i == 0) share_goal(own);
  }
}

void TeamDecision::choose_on_ground(const Estimate& e, const Tick& tick) {
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    expectation_.prepare(e, i, exploration_.expected(), exploration_.settings().variance_expected_m2);
    const SmallVector state = e.belief.mean(e.bodies[i].block);
    ActionChoice& choice = on_ground_[i];
    const bool decided =
        choice.choose(e.belief, e.bodies[i].block, state, *action_set_[i], expectation_, tick);
    if (decided) {
      const SmallVector after = action_set_[i]->after(state, choice.chosen()).state;
      goal_.team[i] = {e.bodies[i].pose.position, pose_of(team_.bodies[i].motion, after).position,
                       heading_by(team_.bodies[i].motion, after), 0};
    }
    if (i > 0) continue;
    goal_.scores = choice.scores();
    goal_.chosen = choice.chosen();
    goal_.decided = decided;
    if (!decided) continue;
    goal_.from = goal_.team[0].from;
    goal_.to = goal_.team[0].to;
    goal_.start_t = tick.t;
    goal_.end_t = choice.end_t();
  }
}

Goal TeamDecision::choose(const Estimate& e, const Observation&, const Tick& tick) {
  goal_.decided = false;
  if (!e.started || e.status.state == TrackingState::lost) {
    for (FreeCameraChoice& choice : in_space_) choice.forget();
    for (VehicleChoice& choice : carried_) choice.forget();
    for (ActionChoice& choice : on_ground_) choice.forget();
    return goal_ = {};
  }
  goal_.team.resize(e.bodies.size());
  explore(e, tick);
  if (!carried_.empty())
    choose_for_carrier(e, tick);
  else if (!in_space_.empty())
    choose_in_space(e, tick);
  else
    choose_on_ground(e, tick);
  if (goal_.decided && exploration_.settings().expected_landmarks > 0 &&
      (!entropy_due_t_ || has_come(*entropy_due_t_, tick.t))) {
    goal_.entropy_extended = extended_entropy(e, exploration_.settings());
    entropy_due_t_ = tick.t + entropy_period_s(e.belief.errors());
  }
  return goal_;
}

}  // namespace incognita
