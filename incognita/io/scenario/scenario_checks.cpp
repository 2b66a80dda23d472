#include "incognita/io/scenario/scenario_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/decision_checks.hpp"
#include "incognita/io/scenario/settings.hpp"
#include "incognita/io/scenario/team_checks.hpp"
#include "incognita/io/scenario/team_setting_list.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

void check_sources(const Scenario& s, List& found) {
  if (s.run.world == "recording" && s.recording.folder.empty()) {
    found.push_back({"recording.folder", "must name the recording, run.world being `recording`"});
  }
  if (s.run.sensor == "camera" && s.start.from == StartSettings::From::target && s.start.target.empty()) {
    found.push_back(
        {"start.target",
         "must name a target file, start.from being `target`; without a target write start.from = "
         "\"free\": the camera starts at the origin, and lengths are relative"});
  }
}

void check_sizes(const Scenario& s, List& found) {
  const InitializationSettings& initialization = s.slam.initialization;
  const auto fits = [&](const char* key, int size, const char* other, int limit) {
    if (size > limit) found.push_back({key, fmt::format("must be at most {}, which is {}", other, limit)});
  };
  fits("birth.box_width_px", initialization.box_width_px, "camera.width_px", s.camera.width_px);
  fits("birth.box_height_px", initialization.box_height_px, "camera.height_px", s.camera.height_px);
  fits("map.wanted_visible", s.slam.map.wanted_visible, "map.max_landmarks", s.slam.map.max_landmarks);
  fits("lost.min_matches", s.slam.lost.min_matches, "search.max_measurements",
       s.slam.search.max_measurements);
  if (initialization.max_depth_m <= initialization.min_depth_m) {
    found.push_back({"birth.max_depth_m", fmt::format("must be more than birth.min_depth_m, which is {}",
                                                      initialization.min_depth_m)});
  }
}

/// The search tests whole pixels only, and the smallest search ellipse is that of the pixel noise alone.
void check_search(const Scenario& s, List& found) {
  constexpr double least_px = 0.75;  // slightly more than half a pixel diagonal
  if (s.slam.search.gate_sigmas * s.slam.filter.sigma_pixel_px >= least_px) return;
  found.push_back(
      {"filter.sigma_pixel_px",
       fmt::format("must be at least {:.3g} with search.gate_sigmas = {:g}: smaller ellipses hold no pixel",
                   least_px / s.slam.search.gate_sigmas, s.slam.search.gate_sigmas)});
}

void check_bounds(const Scenario& s, List& found) {
  for (int axis = 0; axis < 3; ++axis) {
    if (s.decision.max_bound_m[axis] > s.decision.min_bound_m[axis]) continue;
    found.push_back({"decision.max_bound_m",
                     fmt::format("must be more than decision.min_bound_m along {}, {} and {} leave no room",
                                 "xyz"[axis], s.decision.min_bound_m[axis], s.decision.max_bound_m[axis])});
  }
}

void check_room_size(const Eigen::Vector3d& size, List& found) {
  if (std::min(size.x(), size.y()) >= 2 && size.z() <= 20) return;
  found.push_back({"room.size_m", "must be 2 to 50 long and wide, 1.8 to 20 high"});
}

void check_room(const Scenario& s, List& found) {
  if (s.run.world != "room") return;
  if (constexpr double most_frames = 1e9; s.run.duration_s * s.run.rate_hz > most_frames) {
    found.push_back({"run.duration_s", fmt::format("must make at most {:g} frames, run.rate_hz being {}",
                                                   most_frames, s.run.rate_hz)});
  }
  const Eigen::Vector3d &size = s.room.size_m, &start = s.room.start_position_m;
  check_room_size(size, found);
  if (is_room_vehicle(s)) return;  // it starts on the ground
  const double margin = s.room.clearance_m;
  const bool inside = std::abs(start.x()) <= size.x() / 2 - margin &&
                      std::abs(start.y()) <= size.y() / 2 - margin && start.z() >= margin &&
                      start.z() <= size.z() - margin;
  if (inside) return;
  found.push_back({"room.start_position_m",
                   fmt::format("must be inside room.size_m [{}, {}, {}], room.clearance_m {} from the walls",
                               size.x(), size.y(), size.z(), margin)});
}

void check_vehicle(const Scenario& s, List& found) {
  if (s.run.world != "recording")
    found.push_back({"run.world", "must be `recording` with run.sensor = `range-bearing`"});
  if (const auto conflict = find_incompatibility(s.planar.filter))
    found.push_back({conflict->key, conflict->why});
  if (s.planar.start.at_first_fix && s.planar.start.position_m != Eigen::Vector2d::Zero())
    found.push_back(
        {"vehicle_start.position_m", "must be left out where vehicle_start.at_first_fix is true"});
}

/// Checks what is restricted without a team.
void check_alone(const Scenario& s, List& found) {
  const auto models = {"ackermann", "differential-drive"};
  if (s.run.sensor == "range-bearing" &&
      std::find(models.begin(), models.end(), s.planar.vehicle.model) == models.end())
    found.push_back({"vehicle.model",
                     "must be `ackermann` or `differential-drive` where nothing is simulated; "
                     "the others move with run.world = `points`"});
  if (s.run.sensor == "bearing" || s.run.sensor == "stereo")
    found.push_back({"run.sensor", "must be `camera` or `range-bearing` with run.world = `" + s.run.world +
                                       "`; the others see with run.world = `points`"});
}

bool one_of_formats(const std::string& format, std::initializer_list<std::string_view> formats) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

void check_format(const Scenario& s, List& found) {
  const std::string& format = s.recording.format;
  if (s.run.world != "recording" || format == "auto") return;
  const bool ranges = one_of_formats(format, {"acfr", "mrclam", "tables"});
  if (ranges == (s.run.sensor == "range-bearing")) return;
  found.push_back({"recording.format", fmt::format("must be {} with run.sensor = `{}`",
                                                   ranges ? "`auto`, `images`, `tum` or `euroc`"
                                                          : "`auto`, `acfr`, `mrclam` or `tables`",
                                                   s.run.sensor)});
}

}  // namespace

std::vector<Contradiction> find_contradictions(const Scenario& scenario) {
  List found;
  if (is_team(scenario)) {
    check_team(scenario, found);
    if (scenario.team.steer.law == "active") check_decision(scenario, found);
    return found;
  }
  check_sources(scenario, found);
  check_format(scenario, found);
  check_alone(scenario, found);
  if (scenario.run.sensor == "range-bearing") {
    check_vehicle(scenario, found);
    return found;
  }
  check_camera(scenario, found);
  check_sizes(scenario, found);
  check_search(scenario, found);
  if (is_room_vehicle(scenario)) {
    check_room(scenario, found);
    check_room_vehicle(scenario, found);
    if (scenario.team.steer.law == "active") {
      check_bounds(scenario, found);
      check_decision(scenario, found);
    }
    return found;
  }
  check_bounds(scenario, found);
  check_decision(scenario, found);
  check_room(scenario, found);
  return found;
}

}  // namespace incognita
