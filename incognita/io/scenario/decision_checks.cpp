#include "incognita/io/scenario/decision_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "incognita/io/scenario/team_setting_list.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

void check_actions(const DecisionSettings& s, List& found) {
  const auto& moves = s.moves_m;
  if (!moves.empty() && std::none_of(moves.begin(), moves.end(), [](const auto& m) { return m.isZero(); }))
    found.push_back(
        {"decision.moves_m", "must have [0, 0, 0], to stay: what is done where nothing else is allowed"});
  const auto& speeds = s.accelerations;
  if (!speeds.empty() &&
      std::none_of(speeds.begin(), speeds.end(), [](const auto& change) { return change.isZero(); }))
    found.push_back({"decision.accelerations", "must have [0, 0], to go on as it goes"});
  if (s.strategy == DecisionSettings::Strategy::fixed_path && s.sequence.empty())
    found.push_back({"decision.sequence", "must name actions, decision.strategy being `fixed-path`"});
}

void check_horizon(const DecisionSettings& s, List& found) {
  if (s.horizon == 1) return;
  if (s.metric == Metric::position_and_map)
    found.push_back({"decision.horizon", "must be 1 with decision.metric = `position-and-map`"});
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
    return found.push_back({"explore.max_m", "must be more than explore.min_m along each axis"});
  constexpr double most_cells = 1e6;
  if (((e.max_m - e.min_m) / e.cell_m).array().ceil().prod() > most_cells)
    return found.push_back({"explore.cell_m", "must make at most a million cells of the place"});
  if (s.run.world == "recording") return;
  Eigen::Vector3d min(-s.room.size_m.x() / 2, -s.room.size_m.y() / 2, 0), max = min + s.room.size_m;
  const char* what = "the room, room.size_m";
  if (s.run.world == "points") {
    if (!s.team.points.file.empty()) return;
    const Eigen::Vector3d& size = s.team.points.size_m;
    const Eigen::Vector2d& center = s.team.points.center_m;
    min = {center.x() - size.x() / 2, center.y() - size.y() / 2, 0};
    max = min + size;
    what = "where the points are, points.size_m and points.centre_m";
  }
  if (!inside(min, max, e))
    found.push_back(
        {"explore.max_m", fmt::format("must, with explore.min_m, lie inside {}: [{:g}, {:g}, {:g}] to "
                                      "[{:g}, {:g}, {:g}]; landmarks are not expected outside",
                                      what, min.x(), min.y(), min.z(), max.x(), max.y(), max.z())});
}

bool holds(const DecisionSettings& d, const Eigen::Vector3d& at, int axes) {
  return (at.head(axes).array() >= d.min_bound_m.head(axes).array()).all() &&
         (at.head(axes).array() <= d.max_bound_m.head(axes).array()).all();
}

/// Checks the start in the rendered room; team_checks.cpp does so for point landmarks.
void check_start(const Scenario& s, List& found) {
  if (s.run.world != "room") return;
  if (!is_room_vehicle(s)) {
    if (!holds(s.decision, s.room.start_position_m, 3))
      found.push_back(
          {"decision.min_bound_m", "must, with decision.max_bound_m, leave room.start_position_m inside"});
    return;
  }
  if (s.team.steer.law != "active") return;
  for (const Eigen::Vector3d& at : s.team.start.positions_m)
    if (!holds(s.decision, at, 2))
      return found.push_back(
          {"decision.min_bound_m", "must, with decision.max_bound_m, leave team.positions_m inside"});
}

/// The operator perceives the pose in the room frame, goals are in the filter's frame: only a target aligns both.
void check_held(const Scenario& s, List& found) {
  if (s.operator_settings.holds && s.run.world == "room" && s.start.from == StartSettings::From::free)
    found.push_back({"person.holds",
                     "must be false with start.from = \"free\": the hand is told where to move "
                     "in the frame of the room, which only a target fixes"});
}

void check_counted(const Scenario& s, List& found) {
  if (s.exploration.counted == ExplorationSettings::Counted::as_mapped && s.run.world == "points")
    found.push_back(
        {"explore.counted", "must be `all` with run.world = \"points\": all in view is mapped there"});
}

/// Only CameraController implements the swinging gaze; it is used in the rendered room and with recordings.
void check_gaze(const Scenario& s, List& found) {
  const bool is_free_camera = motion_traits_of(s.planar.vehicle.model).in_space() && !has_carried_camera(s);
  if (s.run.world == "points" && is_free_camera && s.team.steer.law == "active" &&
      s.decision.gaze == DecisionSettings::Gaze::swing)
    found.push_back({"decision.gaze",
                     "must be `hold`, `constant-rate`, `mutual-information`, `fisher` or "
                     "`fisher-given-state` with run.world = `points`: the swing to and fro is "
                     "of the rendered room"});
}

}  // namespace

void check_decision(const Scenario& scenario, List& found) {
  check_actions(scenario.decision, found);
  check_horizon(scenario.decision, found);
  check_box(scenario, found);
  check_counted(scenario, found);
  check_gaze(scenario, found);
  check_held(scenario, found);
  check_start(scenario, found);
}

}  // namespace incognita
