#include "incognita/decision/carrier_choice.hpp"

namespace incognita {

Mobility mobility_of(const DecisionSettings& s, const CarrierSettings& carrier) {
  Mobility can;
  can.axes = 2;
  can.step_m = carrier.max_speed_m_s * s.period_s;
  can.speed_m_s = carrier.max_speed_m_s;
  can.turn_rate_rad_s = carrier.max_turn_rate_rad_s;
  can.drives = true;
  can.yaw_rad = carrier.mount.yaw_rad;
  can.forward_m = carrier.mount.forward_m;
  can.clearance_m = carrier.clearance_m;
  can.arrives = false;
  return can;
}

CarrierChoice::CarrierChoice(const DecisionSettings& s, const CarrierSettings& carrier,
                             double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2,
                             std::uint64_t seed, std::size_t who)
    : changes_(speed_changes_of(s), s.period_s,
               growth_over(s.period_s, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2),
               {s.min_bound_m, s.max_bound_m}, carrier.mount, carrier.max_speed_m_s,
               carrier.max_turn_rate_rad_s),
      choice_(s, names_of(changes_.actions()), seed, 3, who, mobility_of(s, carrier)) {}

void CarrierChoice::forget() {
  choice_.forget();
  drive_.setZero();
}

void CarrierChoice::choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                           const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) {
  const BlockVector camera = belief.mean(body.block);
  BlockVector state(camera.size() + 2);
  state << camera, body.wheels.value_or(drive_);
  goal.decided = choice_.choose(belief, body.block, state, changes_, expectation, tick, surroundings);
  goal.scores = choice_.scores();
  goal.chosen = choice_.chosen();
  if (goal.decided) {
    const BlockVector after = changes_.after(state, goal.chosen).state;
    drive_ = after.tail<2>();
    goal.from = camera.head<3>();
    goal.to = after.head<3>();
    goal.start_t = tick.t;
    goal.end_t = choice_.end_t();
  }
  goal.drive = drive_;
}

}  // namespace incognita
