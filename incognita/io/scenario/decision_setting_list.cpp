#include "incognita/io/scenario/decision_setting_list.hpp"

#include "incognita/io/scenario/allowed.hpp"

namespace incognita {
namespace {

using namespace allowed;
using List = std::vector<Setting>;

void strategy(List& list, DecisionSettings& s) {
  list.insert(
      list.end(),
      {
          {"decision.strategy", &s.strategy, "", "none: stay where it started", words(s.strategy)},
          {"decision.metric", &s.metric, "",
           "what is to be learnt: all; without gaze and velocities; the vehicle alone", words(s.metric)},
          {"decision.horizon", &s.horizon, "", "actions looked ahead; 1: greedy", between(1, 20)},
          {"decision.max_evaluations", &s.max_evaluations, "",
           "of imagined looks in one comparison, more than which no longer sequence is followed",
           between(1, 10000000)},
          {"decision.schedule", &s.schedule, "",
           "when actions are scored: all in every frame, all when one is chosen, or one a frame in "
           "random order",
           words(s.schedule)},
          {"decision.sequence", &s.sequence, "",
           "fixed-path: names of actions with spaces between, again and again", any()},
          {"decision.period_s", &s.period_s, "s", "an action lasts this long, then all are compared again",
           between(0.001, 1e4)},
          {"decision.min_bound_m", &s.min_bound_m, "m", "goals outside this box of the world are not chosen",
           any()},
          {"decision.max_bound_m", &s.max_bound_m, "m", "goals outside this box of the world are not chosen",
           any()},
      });
}

void actions(List& list, DecisionSettings& s) {
  list.insert(
      list.end(),
      {
          {"decision.step_m", &s.step_m, "m", "displacement of each of the seven translations",
           above_up_to(0, 1000)},
          {"decision.moves_m", &s.moves_m, "m",
           "instead: displacements along heading, left and up; one must be [0, 0, 0]", between(-1000, 1000)},
          {"decision.acceleration_m_s2", &s.acceleration_m_s2, "m/s^2",
           "of the vehicle that carries the camera: Table 6.1", above_up_to(0, 1000)},
          {"decision.turn_acceleration_rad_s2", &s.turn_acceleration_rad_s2, "rad/s^2",
           "likewise of its turn rate", above_up_to(0, 1000)},
          {"decision.impulse_s", &s.impulse_s, "s", "accelerations act for so long", above_up_to(0, 1000)},
          {"decision.accelerations", &s.accelerations, "",
           "instead of Table 6.1: [m/s^2, rad/s^2] each; one must be [0, 0]", between(-1000, 1000)},
      });
}

void gaze(List& list, DecisionSettings& s) {
  list.insert(
      list.end(),
      {
          {"decision.gaze", &s.gaze, "",
           "how a free camera turns: to and fro, steadily to the left, or as teaches most", words(s.gaze)},
          {"decision.gaze_rate_rad_s", &s.gaze_rate_rad_s, "rad/s", "of its turns", between(0, 10)},
          {"decision.gaze_period_s", &s.gaze_period_s, "s", "turns are compared again", between(0.001, 1e4)},
          {"decision.gaze_ahead_s", &s.gaze_ahead_s, "s", "how long turns are imagined to last",
           between(0.001, 1e4)},
      });
}

void explore(List& list, ExplorationSettings& s) {
  list.insert(list.end(),
              {
                  {"explore.expected_landmarks", &s.expected_landmarks, "",
                   "in the whole place, mapped or not; 0: nothing unseen is expected", between(0, 1000)},
                  {"explore.variance_expected_m2", &s.variance_expected_m2, "m^2",
                   "of each coordinate of one that is not mapped", above_up_to(0, 1e6)},
                  {"explore.counted", &s.counted, "",
                   "which of those in view count: all, or so many as a camera would map there "
                   "(map.wanted_visible)",
                   words(s.counted)},
                  {"explore.min_m", &s.min_m, "m", "the place: a box of the world", any()},
                  {"explore.max_m", &s.max_m, "m", "the place: a box of the world", any()},
                  {"explore.cell_m", &s.cell_m, "m", "side of the cells that the place is told in",
                   above_up_to(0, 1000)},
                  {"explore.seen_s", &s.seen_s, "s",
                   "a cell in view for so long holds nothing more that is not mapped", above_up_to(0, 1e4)},
              });
}

}  // namespace

void list_decision_settings(List& list, DecisionSettings& decision, ExplorationSettings& exploration) {
  strategy(list, decision);
  actions(list, decision);
  gaze(list, decision);
  explore(list, exploration);
}

}  // namespace incognita
