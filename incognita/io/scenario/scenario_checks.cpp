#include "incognita/io/scenario/scenario_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/messages/unfit_setting.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

void check_sources(const Scenario& s, List& found) {
  if (s.is_recording() && s.recording.folder.empty())
    found.push_back({"recording.folder", "must name the recording, world.type being `recording`"});
  if (s.is_live() && s.live.source.empty())
    found.push_back({"live.source", "must name a camera, e.g. `browser` or `/dev/video0`"});
  if (s.is_recording() && s.start.from == StartSettings::From::free && s.sensor.type == "camera" &&
      s.recording.truth_frame == RecordingSettings::TruthFrame::estimate)
    found.push_back({"recording.truth_frame",
                     "must be `own` without a target: frame and scale of the estimate are arbitrary then"});
  if (s.sensor.type == "camera" && s.start.from == StartSettings::From::target && s.start.target.empty())
    found.push_back(
        {"start.target",
         "must name a target file, start.from being `target`; without a target write start.from = "
         "\"free\": the camera starts at the origin, and lengths are relative"});
}

void check_depths(const InitializationSettings& initialization, List& found) {
  if (initialization.max_depth_m <= initialization.min_depth_m)
    found.push_back({"landmark_initialization.max_depth_m",
                     fmt::format("must be more than landmark_initialization.min_depth_m, which is {}",
                                 initialization.min_depth_m)});
}

void check_sizes(const Scenario& s, List& found) {
  const InitializationSettings& initialization = s.slam.initialization;
  const auto fits = [&](const char* key, int size, const char* other, int limit) {
    if (size > limit) found.push_back({key, fmt::format("must be at most {}, which is {}", other, limit)});
  };
  if (initialization.selection == InitializationSettings::Selection::random_box) {
    fits("landmark_initialization.box_width_px", initialization.box_width_px, "camera.width_px",
         s.camera.width_px);
    fits("landmark_initialization.box_height_px", initialization.box_height_px, "camera.height_px",
         s.camera.height_px);
  }
  fits("map.wanted_visible", s.slam.map.wanted_visible, "map.max_landmarks", s.slam.map.max_landmarks);
  if (s.slam.search.max_measurements > 0)
    fits("health.min_matches", s.slam.health.min_matches, "search.max_measurements",
         s.slam.search.max_measurements);
}

void check_room(const Scenario& s, List& found) {
  const auto* trajectory = std::get_if<TrajectoryMotion>(&s.true_motion.type);
  if (s.has_recorded_motion() && trajectory->file.empty())
    found.push_back({"motion.file", "must name a trajectory, motion.type being `trajectory`"});
  if (!std::ranges::is_sorted(s.exposure.step_times_s))
    found.push_back({"exposure.step_times_s", "must increase"});
  if (constexpr double most_frames = 1e9; s.run.duration_s * s.run.rate_hz > most_frames)
    found.push_back({"run.duration_s", fmt::format("must make at most {:g} frames, run.rate_hz being {}",
                                                   most_frames, s.run.rate_hz)});
  const Eigen::Vector3d &size = s.room.size_m, &start = s.room.start_position_m;
  if (!(std::min(size.x(), size.y()) >= 2 && size.z() <= 20))
    found.push_back({"room.size_m", "must be 2 to 50 long and wide, 1.8 to 20 high"});
  if (s.is_room_vehicle()) return;  // it starts on the ground
  const double margin = s.room.clearance_m;
  const bool inside = std::abs(start.x()) <= size.x() / 2 - margin &&
                      std::abs(start.y()) <= size.y() / 2 - margin && start.z() >= margin &&
                      start.z() <= size.z() - margin;
  if (inside) return;
  found.push_back({"room.start_position_m",
                   fmt::format("must be inside room.size_m [{}, {}, {}], room.clearance_m {} from the walls",
                               size.x(), size.y(), size.z(), margin)});
}

/// Only known identities can do without a gate.
void check_association(const Scenario& s, List& found) {
  const DataAssociationSettings& a = s.planar.association;
  if (a.method == DataAssociationSettings::Method::known) return;
  if (a.gate_probability > 0.999999999)
    found.push_back({"association.gate_probability",
                     "must be less than 1, at most 0.999999999, unless association.method is `known`"});
  if (a.initialization_probability < a.gate_probability)
    found.push_back(
        {"association.initialization_probability",
         "must be association.gate_probability or more: a detection inside the gate of a landmark "
         "initializes no other"});
}

void check_images(const Scenario& s, List& found) {
  check_camera(s, found);
  check_sizes(s, found);
  check_depths(s.slam.initialization, found);
  if (s.world.type == WorldSettings::Type::room) check_room(s, found);
  if (s.is_room_vehicle()) check_room_vehicle(s, found);
  if (s.is_robot()) check_robot(s, found);
  if (!s.is_camera_vehicle() || s.decides()) check_decision(s, found);
}

}  // namespace

void check_camera(const Scenario& s, List& found) {
  try {
    make_camera(s.camera);
  } catch (const UnfitSetting& error) {
    found.push_back({error.keys.front(), error.what()});
  }
}

std::vector<Contradiction> find_contradictions(const Scenario& scenario) {
  List found;
  check_association(scenario, found);
  if (scenario.is_simulated() || scenario.sensor.type != "camera")
    if (const auto conflict = find_incompatibility(scenario.planar.filter))
      found.push_back({conflict->key, conflict->why});
  if (scenario.is_simulated()) {
    check_team(scenario, found);
    check_depths(scenario.slam.initialization, found);
    if (scenario.decides()) check_decision(scenario, found);
    return found;
  }
  check_sources(scenario, found);
  if (scenario.sensor.type == "camera") {
    check_images(scenario, found);
  } else if (scenario.is_team()) {
    check_team(scenario, found);
  }
  return found;
}

}  // namespace incognita
