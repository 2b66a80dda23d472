// The state of the decision: scores, the current actions, what was seen, and random streams.
#include "incognita/decision/decision.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/frontier.hpp"
#include "incognita/decision/ground_choice.hpp"
#include "incognita/decision/plan/planned_choice.hpp"
#include "incognita/decision/route_rule.hpp"
#include "incognita/decision/taken_over.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {

template <AnyStateArchive Archive>
void serialize(Archive& archive, ManualDrive& drive) {
  auto& [direction, turn] = drive;
  archive(direction, turn);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, BodyGoal& goal) {
  auto& [scores, chosen, decided, from, to, start_t, end_t, heading_rad, heading_rate_rad_s, elevation_rad,
         elevation_rate_rad_s, drive, manual] = goal;
  archive(scores, chosen, decided, from, to, start_t, end_t, heading_rad, heading_rate_rad_s, elevation_rad,
          elevation_rate_rad_s, drive, manual);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, ExpectedLandmark& landmark) {
  auto& [index, position, normal, probability] = landmark;
  archive(index, position, normal, probability);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Approach::Leg& leg) {
  auto& [from, to] = leg;
  archive(from, to);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, GazeDirection& gaze) {
  auto& [heading_rad, elevation_rad] = gaze;
  archive(heading_rad, elevation_rad);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Frontier::Pursuit& pursuit) {
  auto& [cell, viewpoint, until_t] = pursuit;
  archive(cell, viewpoint, until_t);
}

/// Obstacles are read anew by each decision.
void Approach::state(StateArchive& archive) {
  auto& [mobility, stops, under_way, obstacles] = *this;
  archive(stops, under_way);
}

void Route::state(StateArchive& archive) {
  auto& [reach_m, ahead_m, patience, points, to, from, most_m, stalled] = *this;
  archive(points, to, from, most_m, stalled);
  if (!points.empty() && to >= points.size()) throw DamagedState("a leg beyond the end of its route");
}

void RouteRule::state(StateArchive& archive) {
  auto& [center, plan, approach, route] = *this;
  archive(approach, route);
}

void Frontier::state(StateArchive& archive) {
  auto& [bounds, period_s, max_elevation_rad, approach, pursuit, given_up, faces] = *this;
  archive(approach, pursuit, given_up, faces);
  if (pursuit && pursuit->cell < 0) throw DamagedState("a frontier that is no cell");
}

/// The scores of a look-ahead are computed anew by each comparison.
void ActionChoice::state(StateArchive& archive) {
  auto& [settings, names, sequence, look_ahead, rule, random, order_stream, scores, allowed, outside_m, order,
         scored, taken, chosen, end_t] = *this;
  archive(random, order_stream, scores, allowed, outside_m, order, scored, taken, chosen, end_t);
  const bool fits = scores.size() == names.size() && allowed.size() == names.size() &&
                    order.size() == names.size() && chosen >= -1 && chosen < static_cast<int>(names.size());
  if (!fits) throw DamagedState("the scores of other actions");
  if (rule) rule->state(archive);
}

void FreeCameraChoice::state(StateArchive& archive) {
  auto& [settings, translations, turns, choice, gaze, looking, heading_rad, heading_rate_rad_s, gaze_t,
         elevation_rad, elevation_rate_rad_s] = *this;
  archive(choice, looking, heading_rad, heading_rate_rad_s, gaze_t, elevation_rad, elevation_rate_rad_s);
  if (archive.restores() && looking) translations.turn_at(heading_rate_rad_s);
}

void CarrierChoice::state(StateArchive& archive) {
  auto& [changes, choice, drive] = *this;
  archive(choice, drive);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, PlannedMap::Taken& taken) {
  auto& [block, row, errors, J, position, moved, weight] = taken;
  archive(block, row, errors, J, position, moved, weight);
}

void PlannedMap::state(StateArchive& archive) {
  auto& [body_errors, expected_var_m2, taken, covariance] = *this;
  archive(body_errors, expected_var_m2, taken, covariance);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, ImaginedMap::Expected& expected) {
  auto& [index, P] = expected;
  archive(index, P);
}

void ImaginedMap::state(StateArchive& archive) {
  auto& [P, expected] = *this;
  archive(P, expected);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, PlanWorth& worth) {
  auto& [outside_m, blocked, missing_matches, score] = worth;
  archive(outside_m, blocked, missing_matches, score);
}

/// Of a comparison that has begun: plans of several actions are imagined when it is due.
void Planner::state(StateArchive& archive) {
  auto& [settings, map, unmapped, root, worths, level, entropy_before, measurements, scores, evaluations] =
      *this;
  bool has_begun = root.has_value();
  archive(has_begun);
  if (!has_begun) return root.reset();
  if (!root) root = Node{0, {}, ImaginedMap(map)};
  archive(map, unmapped, root->state, root->map, worths, entropy_before);
}

void PlanAtPeriods::state(StateArchive& archive) {
  auto& [settings, growth, planner, approach, scores, chosen, end_t, to] = *this;
  archive(planner, approach, scores, chosen, end_t, to);
}

void PlannedCameraChoice::state(StateArchive& archive) {
  auto& [actions, names, plan, looking, heading_rad, elevation_rad, rates_rad_s] = *this;
  archive(plan, looking, heading_rad, elevation_rad, rates_rad_s);
  plan.check_actions(names.size());
}

void PlannedCarrierChoice::state(StateArchive& archive) {
  auto& [changes, actions, names, plan, drive] = *this;
  archive(plan, drive);
  plan.check_actions(names.size());
}

void ObjectFaces::state(StateArchive& archive) {
  auto& [min, max, size, cells, patience, first, seen_s, expected] = *this;
  archive(seen_s, expected);
}

void SideCells::state(StateArchive& archive) {
  std::vector<double> seen_s;
  for (const SideCell& cell : cells_) seen_s.push_back(cell.seen_s);
  archive(seen_s, covered_, expected_);
  objects_.state(archive);
  if (seen_s.size() != cells_.size() || covered_.size() != cells_.size())
    throw DamagedState("the cells of other walls");
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].seen_s = seen_s[i];
}

void GroundChoice::state(StateArchive& archive) {
  auto& [motion, actions, choice] = *this;
  archive(choice);
}

void Exploration::state(StateArchive& archive) {
  auto& [settings, cells, seen_s, expected, mapped, random, unseen_cells, volume] = *this;
  const std::size_t count = seen_s.size();
  archive(seen_s, expected, mapped, random, unseen_cells);
  if (seen_s.size() != count) throw DamagedState("the seen cells of another exploration volume");
  if (archive.restores()) renew_volume();
}

void Decision::state(StateArchive& archive) {
  auto& [choices, expectation, exploration, sides, entropy, goal, last_t, entropy_due_t] = *this;
  archive.expect_size(choices.size(), "bodies");
  for (const auto& choice : choices) choice->state(archive);
  auto& [bodies, coverage, entropy_extended, volume] = goal;
  bool explores = volume != nullptr;
  if (sides) sides->state(archive);
  archive(exploration, bodies, coverage, entropy_extended, explores, last_t, entropy_due_t);
  if (bodies.size() != choices.size()) throw DamagedState("the goals of other bodies");
  if (archive.restores()) volume = explores ? exploration.volume() : nullptr;
}

void TakenOver::state(StateArchive& archive) {
  auto& [strategy, drives] = *this;
  archive(drives);
  strategy->state(archive);
}

}  // namespace incognita
