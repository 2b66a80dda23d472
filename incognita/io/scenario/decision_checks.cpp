// Checks of decisions and of the exploration prior.
#include "incognita/io/scenario/scenario_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

void check_actions(const DecisionSettings& s, List& found) {
  const auto& moves = s.moves_m;
  if (!moves.empty() && std::none_of(moves.begin(), moves.end(), [](const auto& m) { return m.isZero(); }))
    found.push_back({"decision.displacements_m",
                     "must have [0, 0, 0]: the action that is left where no other is allowed"});
  const auto& speeds = s.accelerations;
  if (!speeds.empty() &&
      std::none_of(speeds.begin(), speeds.end(), [](const auto& change) { return change.isZero(); }))
    found.push_back({"decision.accelerations", "must have [0, 0]: to keep the speed"});
  if (s.strategy == DecisionSettings::Strategy::fixed_path && s.sequence.empty())
    found.push_back({"decision.sequence", "must name actions, decision.strategy being `fixed-path`"});
}

void check_horizon(const DecisionSettings& s, List& found) {
  if (s.horizon == 1) return;
  if (!is_of_sequences(s.metric))
    found.push_back(
        {"decision.horizon", fmt::format("must be 1 with decision.metric = `{}`", word_of(s.metric))});
  if (s.schedule == DecisionSettings::Schedule::one_per_frame)
    found.push_back({"decision.horizon", "must be 1 with decision.schedule = `one-per-frame`"});
}

bool inside(const Eigen::Vector3d& min, const Eigen::Vector3d& max, const ExplorationSettings& s) {
  constexpr double rounding = 1e-9;
  return (s.min_m.array() >= min.array() - rounding).all() &&
         (s.max_m.array() <= max.array() + rounding).all();
}

void check_box(const Scenario& s, List& found) {
  const ExplorationSettings& e = s.exploration;
  if (e.expected_landmarks == 0) return;
  if ((e.max_m.array() <= e.min_m.array()).any())
    return found.push_back(
        {"exploration.volume_max_m", "must be more than exploration.volume_min_m along each axis"});
  constexpr double most_cells = 1e6;
  if (((e.max_m - e.min_m) / e.cell_m).array().ceil().prod() > most_cells)
    return found.push_back({"exploration.cell_m", "must make at most a million cells of the volume"});
  if (s.is_recording() || s.is_live() || s.is_robot()) return;
  Eigen::Vector3d min(-s.room.size_m.x() / 2, -s.room.size_m.y() / 2, 0), max = min + s.room.size_m;
  const char* what = "the room, room.size_m";
  if (s.is_simulated()) {
    if (!s.points.file.empty()) return;
    const Eigen::Vector3d& size = s.points.size_m;
    const Eigen::Vector2d& center = s.points.center_m;
    min = {center.x() - size.x() / 2, center.y() - size.y() / 2, 0};
    max = min + size;
    what = "the box of the landmarks, points.size_m and points.center_m";
  }
  if (!inside(min, max, e))
    found.push_back({"exploration.volume_max_m",
                     fmt::format("must, with exploration.volume_min_m, lie inside {}: [{:g}, {:g}, {:g}] to "
                                 "[{:g}, {:g}, {:g}]; landmarks are not expected outside",
                                 what, min.x(), min.y(), min.z(), max.x(), max.y(), max.z())});
}

bool holds(const DecisionSettings& d, const Eigen::Vector3d& at, int axes) {
  return (at.head(axes).array() >= d.min_bound_m.head(axes).array()).all() &&
         (at.head(axes).array() <= d.max_bound_m.head(axes).array()).all();
}

/// The bounds must have a volume and contain the starts. The height of a vehicle follows the ground.
void check_bounds(const Scenario& s, List& found) {
  const DecisionSettings& d = s.decision;
  for (int axis = 0; axis < 3; ++axis)
    if (d.max_bound_m[axis] <= d.min_bound_m[axis])
      return found.push_back(
          {"decision.max_bound_m", fmt::format("must be more than decision.min_bound_m along {}: {} and {}",
                                               "xyz"[axis], d.min_bound_m[axis], d.max_bound_m[axis])});
  if (s.is_recording() || s.is_live() || s.is_robot()) return;
  const bool one_camera = !s.is_simulated() && !s.is_room_vehicle();
  const int axes = s.has_carried_camera() || s.is_room_vehicle() ? 2 : 3;
  const std::vector<Eigen::Vector3d> one{s.room.start_position_m};
  for (const Eigen::Vector3d& at : one_camera ? one : s.team_start.positions_m)
    if (!holds(d, at, axes))
      return found.push_back(
          {"decision.min_bound_m", fmt::format("must, with decision.max_bound_m, contain {}",
                                               one_camera ? "room.start_position_m" : "start.positions_m")});
}

/// What the strategies that are rules go by must be given.
void check_rules(const Scenario& s, List& found) {
  using Strategy = DecisionSettings::Strategy;
  const DecisionSettings& d = s.decision;
  const bool by_bounds = d.strategy == Strategy::lawn_mower || d.strategy == Strategy::wall_follower;
  if (by_bounds && !d.has_sides())
    return found.push_back(
        {"decision.min_bound_m",
         fmt::format("must be given, and decision.max_bound_m, with decision.strategy = `{}`: it goes by the "
                     "sides of the bounds",
                     word_of(d.strategy))});
  const double narrow_m = (d.max_bound_m - d.min_bound_m).head<2>().minCoeff();
  if (d.strategy == Strategy::wall_follower && !(2 * d.wall_distance_m < narrow_m))
    found.push_back({"decision.wall_distance_m",
                     fmt::format("must be less than {:g}, half of the narrower side of decision.min_bound_m "
                                 "to decision.max_bound_m, with decision.strategy = `wall-follower`",
                                 narrow_m / 2)});
  if (d.strategy == Strategy::frontier && s.exploration.expected_landmarks == 0)
    found.push_back({"exploration.expected_landmarks",
                     "must be more than 0 with decision.strategy = `frontier`, which goes to unseen cells of "
                     "the exploration volume"});
  const bool free_camera = !s.has_carried_camera() && !s.is_camera_vehicle();
  if (d.strategy == Strategy::frontier && free_camera && d.gaze_rate_rad_s == 0)
    found.push_back({"decision.gaze_rate_rad_s",
                     "must be more than 0 with decision.strategy = `frontier`, which turns the gaze"});
}

/// The operator perceives the pose in the room frame, goals are in the filter's frame: only a target aligns both.
void check_operator(const Scenario& s, List& found) {
  if (s.operator_settings.holds && !s.is_simulated() && s.start.from == StartSettings::From::free)
    found.push_back(
        {"operator.holds",
         "must be false with start.from = \"free\": the operator moves in the frame of the room, which "
         "only a target gives to the estimator"});
}

}  // namespace

void check_decision(const Scenario& scenario, List& found) {
  check_actions(scenario.decision, found);
  check_horizon(scenario.decision, found);
  check_box(scenario, found);
  check_bounds(scenario, found);
  check_rules(scenario, found);
  check_operator(scenario, found);
}

}  // namespace incognita
