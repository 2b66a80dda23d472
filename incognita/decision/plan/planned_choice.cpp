#include "incognita/decision/plan/planned_choice.hpp"

#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

PlannerSettings planner_of(const DecisionSettings& s) {
  PlannerSettings plan;
  plan.held_periods.assign(static_cast<std::size_t>(s.horizon), s.held_periods);
  plan.held_periods.front() = 1;
  plan.views_per_period = s.views_per_period;
  plan.period_s = s.period_s;
  plan.max_evaluations = s.max_evaluations;
  plan.min_matches = s.min_matches;
  plan.pose_weight = s.pose_weight;
  plan.resolution = {s.resolution_m / 2, s.resolution_m / 5};
  return plan;
}

}  // namespace

PlanAtPeriods::PlanAtPeriods(const DecisionSettings& s, const Mobility& mobility,
                             double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2)
    : settings_(s),
      growth_(growth_over(s.period_s / s.views_per_period, sigma_acceleration_m_s2,
                          sigma_angular_acceleration_rad_s2)),
      planner_(planner_of(s)),
      approach_(mobility) {}

void PlanAtPeriods::forget() {
  chosen_ = -1;
  approach_.forget();
}

bool PlanAtPeriods::choose(const BlockVector& state, const MoveSet& moves, const Body& body,
                           const Expectation& expectation, const Surroundings& around, const Tick& tick) {
  if (chosen_ >= 0 && !has_come(end_t_, tick.t)) return false;
  const Estimate& estimate = *around.estimate;
  approach_.update(state, around);
  const auto which = static_cast<std::size_t>(&body - estimate.bodies.data());
  chosen_ = planner_.choose(
      {estimate, which, state, moves, growth_, expectation, around.expected, around.expected_var_m2,
       [&](const BlockVector& at) { return approach_.is_clear(position_in(at, approach_.mobility())); }});
  scores_ = planner_.scores();
  end_t_ = tick.t + settings_.period_s;
  approach_.go({position_in(state, approach_.mobility()),
                position_in(moves.along(state, chosen_, settings_.period_s), approach_.mobility())});
  return true;
}

PlannedCameraChoice::PlannedCameraChoice(const DecisionSettings& s, const Mobility& mobility,
                                         double sigma_acceleration_m_s2,
                                         double sigma_angular_acceleration_rad_s2)
    : moves_(translations_of(s), s.period_s, s.gaze_rate_rad_s, {s.min_bound_m, s.max_bound_m}),
      names_(moves_.names()),
      plan_(s, mobility, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2) {}

void PlannedCameraChoice::forget() {
  plan_.forget();
  looking_ = false;
}

void PlannedCameraChoice::choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                                 const Surroundings& around, const Tick& tick, BodyGoal& goal) {
  const BlockVector camera = belief.mean(body.block);
  if (!looking_)
    heading_rad_ = heading_of(Eigen::Vector4d(camera.segment<4>(3))), heading_rate_rad_s_ = 0;
  else
    heading_rad_ += heading_rate_rad_s_ * tick.dt;
  looking_ = true;
  goal.decided = plan_.choose(camera, moves_, body, expectation, around, tick);
  goal.scores = plan_.scores();
  goal.chosen = plan_.chosen();
  if (goal.decided) {
    heading_rate_rad_s_ = moves_.rate_of(goal.chosen);
    goal.from = camera.head<3>();
    goal.to = moves_.along(camera, goal.chosen, plan_.end_t() - tick.t).head<3>();
    goal.start_t = tick.t;
    goal.end_t = plan_.end_t();
  }
  goal.heading_rad = heading_rad_;
  goal.heading_rate_rad_s = heading_rate_rad_s_;
}

PlannedCarrierChoice::PlannedCarrierChoice(const DecisionSettings& s, const CarrierSettings& carrier,
                                           const Mobility& mobility, double sigma_acceleration_m_s2,
                                           double sigma_angular_acceleration_rad_s2)
    : changes_(speed_changes_of(s), s.period_s,
               growth_over(s.period_s, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2),
               {s.min_bound_m, s.max_bound_m}, carrier.mount, carrier.max_speed_m_s,
               carrier.max_turn_rate_rad_s),
      moves_(changes_),
      names_(names_of(changes_.actions())),
      plan_(s, mobility, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2) {}

void PlannedCarrierChoice::forget() {
  plan_.forget();
  drive_.setZero();
}

void PlannedCarrierChoice::choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                                  const Surroundings& around, const Tick& tick, BodyGoal& goal) {
  const BlockVector camera = belief.mean(body.block);
  BlockVector state(camera.size() + 2);
  state << camera, body.wheels.value_or(drive_);
  goal.decided = plan_.choose(state, moves_, body, expectation, around, tick);
  goal.scores = plan_.scores();
  goal.chosen = plan_.chosen();
  if (goal.decided) {
    const BlockVector after = moves_.along(state, goal.chosen, plan_.end_t() - tick.t);
    drive_ = after.tail<2>();
    goal.from = camera.head<3>();
    goal.to = after.head<3>();
    goal.start_t = tick.t;
    goal.end_t = plan_.end_t();
  }
  goal.drive = drive_;
}

}  // namespace incognita
