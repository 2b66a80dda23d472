#include "incognita/decision/plan/planned_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "incognita/math/saved_state/state_archive.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

PlannerSettings planner_of(const DecisionSettings& s, const Mobility& mobility) {
  PlannerSettings plan;
  plan.held_periods.assign(static_cast<std::size_t>(s.horizon), s.held_periods);
  plan.held_periods.front() = 1;
  plan.views_per_period = s.views_per_period;
  plan.period_s = s.period_s;
  plan.max_evaluations = s.max_evaluations;
  plan.min_matches = s.min_matches;
  plan.pose_weight = s.pose_weight;
  plan.discount_s = s.discount_s;
  plan.reach.speed_m_s = mobility.speed_m_s;
  plan.reach.turn_rate_rad_s = mobility.turn_rate_rad_s;
  plan.resolution = {s.resolution_m / 2, s.resolution_m / 5};
  return plan;
}

}  // namespace

PlanAtPeriods::PlanAtPeriods(const DecisionSettings& s, const Mobility& mobility,
                             double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2)
    : settings_(s),
      growth_(growth_over(s.period_s / s.views_per_period, sigma_acceleration_m_s2,
                          sigma_angular_acceleration_rad_s2)),
      planner_(planner_of(s, mobility)),
      approach_(mobility) {}

void PlanAtPeriods::forget() {
  chosen_ = -1;
  to_.reset();
  planner_.forget();
  approach_.forget();
}

void PlanAtPeriods::check_actions(std::size_t count) const {
  if ((!scores_.empty() && scores_.size() != count) || chosen_ < -1 || chosen_ >= static_cast<int>(count))
    throw DamagedState("the scores of other actions");
}

/// Imagines actions in the last part of the period, equally many in each tick.
void PlanAtPeriods::prepare(const Planner::Input& now, const Tick& tick) {
  const double left_s = end_t_ - tick.t, prepare_s = std::min(settings_.prepare_s, settings_.period_s);
  if (left_s > prepare_s || settings_.horizon > 1) return;
  if (!planner_.has_begun()) planner_.begin(now, Planner::UnderWay{now.actions.then(chosen_), left_s, to_});
  const int ticks = std::max(1, static_cast<int>(std::lround(prepare_s / tick.dt)));
  planner_.imagine(now, (now.actions.count() + ticks - 1) / ticks);
}

bool PlanAtPeriods::choose(const BlockVector& state, const ActionPaths& actions, const Body& body,
                           const Expectation& expectation, const Surroundings& around, const Tick& tick) {
  const Estimate& estimate = *around.estimate;
  const auto which = static_cast<std::size_t>(&body - estimate.bodies.data());
  const bool is_due = chosen_ < 0 || has_come(end_t_, tick.t);
  if (is_due) approach_.update(state, around);
  const Planner::Input now{
      estimate,
      which,
      state,
      actions,
      growth_,
      expectation,
      around.unmapped,
      around.expected_var_m2,
      [&](const BlockVector& at) { return approach_.is_clear(position_in(at, approach_.mobility())); }};
  if (!is_due) {
    prepare(now, tick);
    return false;
  }
  if (!planner_.has_begun()) planner_.begin(now, std::nullopt);
  chosen_ = planner_.choose(now);
  scores_ = planner_.scores();
  end_t_ = tick.t + settings_.period_s;
  const BlockVector end = actions.along(state, chosen_, settings_.period_s);
  approach_.go({position_in(state, approach_.mobility()), position_in(end, approach_.mobility())});
  if (approach_.mobility().arrives) to_ = end.head<3>();
  return true;
}

PlannedCameraChoice::PlannedCameraChoice(const DecisionSettings& s, const Mobility& mobility,
                                         double sigma_acceleration_m_s2,
                                         double sigma_angular_acceleration_rad_s2)
    : actions_(translations_of(s), s.period_s, s.gaze_rate_rad_s, s.max_elevation_rad,
               {s.min_bound_m, s.max_bound_m}),
      names_(actions_.names()),
      plan_(s, mobility, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2) {}

void PlannedCameraChoice::forget() {
  plan_.forget();
  looking_ = false;
}

/// Integrates the gaze at its current rates.
void PlannedCameraChoice::look(const BlockVector& camera, double dt) {
  if (!looking_) {
    const Eigen::Vector4d gaze = camera.segment<4>(3);
    heading_rad_ = heading_of(gaze);
    elevation_rad_ = actions_.max_elevation_rad() > 0 ? elevation_of(gaze) : 0;
    rates_rad_s_.setZero();
    looking_ = true;
    return;
  }
  heading_rad_ += rates_rad_s_.x() * dt;
  elevation_rad_ += rates_rad_s_.y() * dt;
  if (std::abs(elevation_rad_) <= actions_.max_elevation_rad()) return;
  elevation_rad_ = std::copysign(actions_.max_elevation_rad(), elevation_rad_);
  rates_rad_s_.y() = 0;
}

void PlannedCameraChoice::choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                                 const Surroundings& around, const Tick& tick, BodyGoal& goal) {
  const BlockVector camera = belief.mean(body.block);
  look(camera, tick.dt);
  goal.decided = plan_.choose(camera, actions_, body, expectation, around, tick);
  goal.scores = plan_.scores();
  goal.chosen = plan_.chosen();
  if (goal.decided) {
    rates_rad_s_ = actions_.rates_of(goal.chosen);
    goal.from = camera.head<3>();
    goal.to = actions_.along(camera, goal.chosen, plan_.end_t() - tick.t).head<3>();
    goal.start_t = tick.t;
    goal.end_t = plan_.end_t();
  }
  goal.heading_rad = heading_rad_;
  goal.heading_rate_rad_s = rates_rad_s_.x();
  goal.elevation_rad = elevation_rad_;
  goal.elevation_rate_rad_s = rates_rad_s_.y();
}

PlannedCarrierChoice::PlannedCarrierChoice(const DecisionSettings& s, const CarrierSettings& carrier,
                                           const Mobility& mobility, double sigma_acceleration_m_s2,
                                           double sigma_angular_acceleration_rad_s2)
    : changes_(speed_changes_of(s), s.period_s,
               growth_over(s.period_s, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2),
               {s.min_bound_m, s.max_bound_m}, carrier.mount, carrier.max_speed_m_s,
               carrier.max_turn_rate_rad_s),
      actions_(changes_),
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
  goal.decided = plan_.choose(state, actions_, body, expectation, around, tick);
  goal.scores = plan_.scores();
  goal.chosen = plan_.chosen();
  if (goal.decided) {
    const BlockVector after = actions_.along(state, goal.chosen, plan_.end_t() - tick.t);
    drive_ = after.tail<2>();
    goal.from = camera.head<3>();
    goal.to = after.head<3>();
    goal.start_t = tick.t;
    goal.end_t = plan_.end_t();
  }
  goal.drive = drive_;
}

}  // namespace incognita
