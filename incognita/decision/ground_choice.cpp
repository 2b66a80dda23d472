#include "incognita/decision/ground_choice.hpp"

#include <algorithm>

namespace incognita {
namespace {

/// A vehicle may need longer than one action to turn to where it leads.
Mobility ground_mobility(const std::vector<Translation>& actions, double period_s, const AnyMotion& motion) {
  Mobility can;
  can.axes = std::min(2, traits_of(motion).position_size);
  can.has_gaze = false;
  can.step_m = longest_m(actions);
  can.speed_m_s = can.step_m / period_s;
  can.arrives = false;
  return can;
}

}  // namespace

GroundChoice::GroundChoice(const DecisionSettings& s, const BodyModel& body, double tick_s,
                           std::uint64_t seed, std::size_t who)
    : motion_(body.motion),
      actions_(body, translations_of(s), s.period_s, tick_s, WorldBounds{s.min_bound_m, s.max_bound_m}),
      choice_(s, names_of(actions_.actions()), seed, traits_of(motion_).position_size, who,
              ground_mobility(actions_.actions(), s.period_s, motion_)) {}

void GroundChoice::choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                          const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) {
  const SmallVector state = belief.mean(body.block);
  goal.decided = choice_.choose(belief, body.block, state, actions_, expectation, tick, surroundings);
  goal.scores = choice_.scores();
  goal.chosen = choice_.chosen();
  if (!goal.decided) return;
  const SmallVector after = actions_.after(state, goal.chosen).state;
  goal.from = pose_of(motion_, state).position;
  goal.to = pose_of(motion_, after).position;
  goal.heading_rad = heading_by(motion_, after);
  goal.start_t = tick.t;
  goal.end_t = choice_.end_t();
}

}  // namespace incognita
