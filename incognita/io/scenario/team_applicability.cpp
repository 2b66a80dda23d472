// Applicability of settings to a team: inapplicable ones are refused, as they would be ignored.
#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "incognita/io/scenario/settings.hpp"
#include "incognita/io/scenario/team_setting_list.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using Words = std::initializer_list<std::string_view>;
bool one_of(std::string_view word, Words words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The choices of a scenario that the rules below depend on.
struct Choices {
  const Scenario& s;
  const std::string& sensor = s.run.sensor;
  const std::string& model = s.planar.vehicle.model;
  const std::string& law = s.team.steer.law;
  const std::string& path = s.team.path.kind;
  bool recorded = s.run.world == "recording";
  const MotionTraits& motion = motion_traits_of(model);
  const SensorTraits& measured = sensor_traits_of(sensor, motion);
  bool camera = measured.dimensions == 3;
  bool body = motion.in_space(), line = motion.on_line(), ground = motion.space == Space::uneven_ground;
  bool turns = motion.has_input("turn_rate"), steers = motion.has_input("steering");
  bool carried = has_carried_camera(s);  ///< a camera whose filter does not model its carrier

  std::string by_sensor() const { return "run.sensor = `" + sensor + "`"; }
  std::string by_model() const { return "vehicle.model = `" + model + "`"; }
  std::string by_plant() const { return "plant.motion = `" + s.team.plant.motion + "`"; }
  std::string by_law() const { return "steer.law = `" + law + "`"; }
  std::string by_path() const { return "path.kind = `" + path + "`"; }
  std::string by_world() const {
    return recorded ? "a recording of a team" : "run.world = `" + s.run.world + "`";
  }
};

std::string unless(bool means, const std::string& why) { return means ? "" : why; }

std::string vehicle(std::string_view key, const Choices& c) {
  return unless(applies_to_motion(std::string(key), c.model), c.by_model());
}

/// Noise settings of range-bearing sensors, in the filter and in the plant.
std::string ranges(std::string_view key, const Choices& c) {
  if (c.camera) return c.by_sensor();
  if (key == "sigma_bearing_rad") return unless(!c.line, c.by_model());
  if (one_of(key, {"sigma_range_m", "sigma_range_ratio"}))
    return unless(c.measured.measures("range"), c.by_sensor());
  return "";
}

std::string filter(std::string_view key, const Choices& c) {
  if (key == "sigma_pixel_px") return unless(c.camera, c.by_sensor());
  if (one_of(key, {"odometry", "sigma_slip_m_s"})) return c.by_world();
  return unless(c.body, c.by_model());
}

std::string plant(std::string_view key, const Choices& c) {
  if (one_of(key, {"sigma_range_m", "sigma_range_ratio", "sigma_bearing_rad"})) return ranges(key, c);
  if (key == "field_of_view_rad")
    return unless(!c.camera && !c.line, c.camera ? c.by_sensor() : c.by_model());
  if (key == "sigma_pixel_px") return unless(c.camera, c.by_sensor());
  if (one_of(key, {"sigma_acceleration_m_s2", "sigma_angular_acceleration_rad_s2"}))
    return unless(c.body && !c.carried, c.carried ? c.by_plant() : c.by_model());
  if (c.carried && one_of(key, {"sigma_speed_m_s", "speed_ratio", "sigma_turn_rate_rad_s", "turn_ratio"}))
    return "";
  if (c.carried && key == "sigma_start_height_m") return c.by_plant();
  if (one_of(key, {"sigma_speed_m_s", "speed_ratio"})) return unless(!c.body, c.by_model());
  if (key == "sigma_steering_rad") return unless(c.steers, c.by_model());
  if (key == "sigma_turn_rate_rad_s") return unless(c.turns, c.by_model());
  if (key == "turn_ratio") return unless(c.turns || c.steers, c.by_model());
  if (key == "motion") return unless((c.motion.is_planar_pose() && c.turns) || c.body, c.by_model());
  if (key == "sigma_start_height_m") return unless(c.body, c.by_model());
  if (key == "sigma_start_heading_rad") return unless(!c.line, c.by_model());
  return "";
}

std::string terrain(std::string_view key, const Choices& c) {
  if (!c.ground && c.s.team.plant.motion != "terrain") return c.by_model();
  const std::string& kind = c.s.team.terrain.kind;
  if (key == "kind") return "";
  const char* of = one_of(key, {"slope_x", "slope_y"})        ? "plane"
                   : one_of(key, {"amplitude_m", "length_m"}) ? "waves"
                                                              : "image";
  return unless(kind == of, "terrain.kind = `" + kind + "`");
}

std::string steer(std::string_view key, const Choices& c) {
  if (key == "law") return "";
  if (key == "keep_clear_m") return unless(is_room_vehicle(c.s), c.by_world());
  if (key == "input") return unless(c.law == "none", c.by_law());
  if (c.carried) return unless(one_of(key, {"max_speed_m_s", "max_turn_rate_rad_s"}), c.by_plant());
  if (key == "max_speed_m_s") return unless(!c.body, c.by_model());
  if (key == "max_turn_rate_rad_s") return unless(c.turns, c.by_model());
  if (key == "max_steering_rad") return unless(c.steers, c.by_model());
  const bool linearized = c.law == "feedback-linearisation" || c.law == "active";
  if (one_of(key, {"weight_state", "weight_input"})) return unless(c.law == "lqg", c.by_law());
  if (key == "gain_per_s") {
    if (c.body) return c.by_model();
    return unless(linearized || (c.law == "tracking" && c.line), c.by_law());
  }
  if (key == "control_point_m") return unless(c.ground && linearized, c.ground ? c.by_law() : c.by_model());
  if (c.law != "tracking") return c.by_law();  // its three gains
  return unless(c.turns, c.by_model());
}

std::string path(std::string_view key, const Choices& c) {
  if (one_of(c.law, {"none", "active"})) return c.by_law();
  if (one_of(key, {"kind", "offsets_m"})) return "";
  if (key == "centre_m") return unless(one_of(c.path, {"point", "circle", "back-and-forth"}), c.by_path());
  if (key == "heading_rad") return unless(c.path == "point" && c.body, c.body ? c.by_path() : c.by_model());
  if (key == "radius_m") return unless(one_of(c.path, {"circle", "back-and-forth"}), c.by_path());
  if (one_of(key, {"rate_rad_s", "phase_rad"})) return unless(c.path == "circle", c.by_path());
  if (key == "amplitude_rad") return unless(c.path == "back-and-forth", c.by_path());
  if (one_of(key, {"points_m", "speed_m_s"})) return unless(c.path == "way-points", c.by_path());
  return unless(c.path == "file", c.by_path());
}

/// Inverse depth applies to sensors without distance; the conversion to points applies to stereo, too.
std::string initialization(std::string_view key, const Choices& c) {
  if (key == "max_linearity")
    return unless(c.measured.initial_form == LandmarkParametrization::Kind::inverse_depth, c.by_sensor());
  if (one_of(key, {"inverse_depth_per_m", "sigma_inverse_depth_per_m"}))
    return unless(!c.measured.measures_distance, c.by_sensor());
  return c.by_world();
}

std::string association(std::string_view key, const Choices& c) {
  if (key == "method") return "";
  const std::string& method = c.s.planar.association.method;
  if (key == "max_nodes") return unless(method == "joint", "association.method = `" + method + "`");
  return unless(method != "known", "association.method = `" + method + "`");
}

std::string points(std::string_view key, const Choices& c) {
  const bool drawn = c.s.team.points.file.empty();
  if (one_of(key, {"count", "size_m", "centre_m"})) return unless(drawn, "points.file");
  return "";
}

std::string control(std::string_view key, const Choices& c) {
  if (!c.body) return c.by_model();
  if (c.carried) return c.by_plant();
  if (key.starts_with("gaze_")) return c.by_world();
  if (key.starts_with("max_")) return unless(c.law != "none", c.by_law());
  return unless(one_of(c.law, {"tracking", "feedback-linearisation", "active"}), c.by_law());
}

std::string decision(std::string_view key, const Choices& c) {
  if (c.law != "active") return c.by_law();
  const bool driven = c.carried || is_room_vehicle(c.s);
  const std::string moved = c.carried ? c.by_plant() : c.by_model();
  if (key.starts_with("gaze")) return unless(c.body && !driven, moved);
  if (one_of(key, {"step_m", "moves_m"})) return unless(!driven, moved);
  if (key == "accelerations" || key == "impulse_s") return unless(driven, moved);
  if (one_of(key, {"acceleration_m_s2", "turn_acceleration_rad_s2"}))
    return unless(driven && c.s.decision.accelerations.empty(), driven ? "decision.accelerations" : moved);
  return "";
}

/// Operator settings apply to a hand-held camera with the active law only.
std::string operator_checks(std::string_view key, const Choices& c) {
  if (!c.body || c.carried) return c.carried ? c.by_plant() : c.by_model();
  if (c.law != "active") return c.by_law();
  return unless(key == "holds" || c.s.operator_settings.holds, "person.holds = false");
}

std::string run(std::string_view key, const Choices& c) {
  if (key == "rate_hz" && c.recorded) return "a recording, which has its own times";
  if (key == "observability") return c.by_world();
  return "";
}

std::string recording(std::string_view key, const Choices& c) {
  if (!c.recorded) return c.by_world();
  return unless(!one_of(key, {"robot", "pattern", "check_calibration"}), "recording.team = true");
}

std::string in_points(const std::string& section, std::string_view key, const Choices& c) {
  if (section == "camera") return unless(c.camera, c.by_sensor());
  if (section == "control") return control(key, c);
  if (section == "person") return operator_checks(key, c);
  if (section == "decision" || section == "explore") return decision(key, c);
  if (section == "points") return points(key, c);
  if (section == "association") return association(key, c);
  if (section == "plant") return plant(key, c);
  if (section == "terrain") return terrain(key, c);
  if (section == "mount")
    return unless(c.camera && (!c.body || c.carried), c.camera ? c.by_model() : c.by_sensor());
  if (is_of_sensor(section)) return unless(c.sensor == section, c.by_sensor());
  if (section == "steer") return steer(key, c);
  if (section == "path") return path(key, c);
  if (section == "filter") return filter(key, c);
  if (section == "birth") return initialization(key, c);
  return c.by_world();
}

/// Applicability of the team settings that a vehicle in the rendered room shares.
std::string on_wheels(const std::string& section, std::string_view key, const Choices& c) {
  if (section == "steer") return steer(key, c);
  if (section == "path") return key == "offsets_m" ? c.by_world() : path(key, c);
  if (section == "terrain") return terrain(key, c);
  if (section == "mount") return "";
  if (section == "team") return unless(one_of(key, {"positions_m", "headings_rad"}), c.by_world());
  if (section == "plant" && key == "ticks_per_look") return c.by_world();
  if (section == "plant" && key == "sigma_pixel_px") return "images, whose noise is room.sigma_image_grey";
  if (section == "plant") return plant(key, c);
  return c.by_world();
}

}  // namespace

bool is_room_vehicle(const Scenario& s) {
  return s.run.world == "room" && s.run.sensor == "camera" &&
         motion_traits_of(s.planar.vehicle.model).space == Space::uneven_ground;
}

std::string inapplicable_to_room_vehicle(const std::string& full_key, const Scenario& s) {
  const Choices c{s};
  const std::string section = section_of(full_key), key = name_in_section(full_key);
  if (one_of(section, {"control", "person", "recording"})) return c.by_model();
  if (one_of(section, {"decision", "explore"})) return decision(key, c);
  if (section == "room" && (key.starts_with("start_") || key.starts_with("sigma_start_") ||
                            one_of(key, {"sigma_acceleration_m_s2", "sigma_angular_acceleration_rad_s2"})))
    return c.by_model();
  if (section == "filter" && key == "sigma_slip_m_s")
    return unless(s.slam.filter.odometry, "filter.odometry = false");
  if (section == "vehicle")
    return unless(one_of(key, {"model", "sigma_speed_m_s", "sigma_turn_rate_rad_s"}), c.by_model());
  if (one_of(section, {"run", "camera", "start", "filter", "search", "birth", "map", "lost", "room"}))
    return "";
  return on_wheels(section, key, c);
}

bool is_team(const Scenario& s) {
  return s.run.world == "points" || (s.run.world == "recording" && s.recording.team);
}

bool has_carried_camera(const Scenario& s) {
  return s.run.world == "points" && motion_traits_of(s.planar.vehicle.model).in_space() &&
         s.team.plant.motion == "terrain";
}

bool is_of_sensor(const std::string& section) {
  const std::vector<SensorEntry>& sensors = registered_sensors();
  return std::any_of(sensors.begin(), sensors.end(), [&](const SensorEntry& sensor) {
    return sensor.traits.word == section && !sensor.parameters.empty();
  });
}

bool is_team_section(const std::string& section) {
  return is_of_sensor(section) ||
         one_of(section, {"team", "team_filter", "points", "plant", "terrain", "mount", "steer", "path"});
}

bool applies_to_motion(const std::string& key, const std::string& model) {
  const MotionTraits& motion = motion_traits_of(model);
  if (key == "sigma_speed_m_s") return motion.has_input("speed");
  if (key == "sigma_turn_rate_rad_s") return motion.has_input("turn_rate");
  if (key == "sigma_steering_rad") return motion.has_input("steering");
  bool of_any = false;
  for (const MotionEntry& entry : registered_motions())
    for (const ParameterInfo& p : entry.parameters) {
      if (p.quantity.key() != key) continue;
      if (entry.traits.name == model) return true;
      of_any = true;
    }
  return !of_any;
}

std::string inapplicable_to_team(const std::string& full_key, const Scenario& s) {
  const Choices c{s};
  const std::string section = section_of(full_key), key = name_in_section(full_key);
  if (section == "run") return run(key, c);
  if (section == "recording") return recording(key, c);
  if (section == "team_filter") return "";
  if (section == "vehicle") return vehicle(key, c);
  if (section == "ranges") return ranges(key, c);
  if (section == "vehicle_lost") return unless(key == "max_sigma_position_m", c.by_world());
  if (section == "team" && c.line && one_of(key, {"headings_rad", "sigma_heading_rad"})) return c.by_model();
  if (section == "team" && key == "sigma_height_m") return unless(c.body, c.by_model());
  if (section == "team")
    return unless(!c.recorded || !one_of(key, {"positions_m", "headings_rad"}), c.by_world());
  return c.recorded ? c.by_world() : in_points(section, key, c);
}

}  // namespace incognita
