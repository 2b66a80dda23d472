#include "incognita/io/scenario/settings.hpp"

#include <algorithm>
#include <initializer_list>

#include "incognita/io/scenario/allowed.hpp"
#include "incognita/io/scenario/decision_setting_list.hpp"
#include "incognita/io/scenario/team_setting_list.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using namespace allowed;
using List = std::vector<Setting>;

void run(List& list, RunSettings& s) {
  list.insert(
      list.end(),
      {
          {"run.world", &s.world, "", "where what is seen comes from",
           one_of({"room", "points", "recording"})},
          {"run.sensor", &s.sensor, "",
           "what the estimator sees with; it decides which sections mean something", one_of(sensor_words())},
          {"run.seed", &s.seed, "", "of every random stream; same seed, same bytes", at_least(0)},
          {"run.duration_s", &s.duration_s, "s", "at most; a recording may end before", above_up_to(0, 1e7)},
          {"run.rate_hz", &s.rate_hz, "Hz",
           "ticks per second of a simulated place, and of recordings without time stamps",
           above_up_to(0, 10000)},
          {"run.observability", &s.observability, "",
           "whether the run works out what its filter can know of frame and scale, and what it only believes",
           any()},
      });
}

void camera(List& list, CameraSettings& s) {
  list.insert(
      list.end(),
      {
          {"camera.model", &s.model, "", "kd1_per_px2 belongs to the one, k1 k2 p1 p2 k3 to the other",
           one_of({"wide-angle", "pinhole"})},
          {"camera.width_px", &s.width_px, "px", "of the image", between(16, 16384)},
          {"camera.height_px", &s.height_px, "px", "of the image", between(16, 16384)},
          {"camera.fu_px", &s.fu_px, "px", "focal length over pixel width", above_up_to(0, 1e6)},
          {"camera.fv_px", &s.fv_px, "px", "focal length over pixel height", above_up_to(0, 1e6)},
          {"camera.u0_px", &s.u0_px, "px", "principal point, the centre of the first pixel being 0", any()},
          {"camera.v0_px", &s.v0_px, "px", "principal point, the centre of the first pixel being 0", any()},
          {"camera.kd1_per_px2", &s.kd1_per_px2, "1/px^2", "radial distortion of the wide-angle camera",
           at_least(0)},
          {"camera.k1", &s.k1, "", "radial distortion of the pinhole camera, as OpenCV has it", any()},
          {"camera.k2", &s.k2, "", "radial, second term", any()},
          {"camera.p1", &s.p1, "", "tangential, first term", any()},
          {"camera.p2", &s.p2, "", "tangential, second term", any()},
          {"camera.k3", &s.k3, "", "radial, third term", any()},
      });
}

void recording(List& list, RecordingSettings& s) {
  list.insert(list.end(),
              {
                  {"recording.folder", &s.folder, "",
                   "images, ranges, or a benchmark's folder; relative to the data folder", any()},
                  {"recording.format", &s.format, "", "auto guesses from the folder and says what it guessed",
                   one_of({"auto", "images", "tum", "euroc", "acfr", "mrclam", "tables"})},
                  {"recording.pattern", &s.pattern, "",
                   "images: only those whose names fit, * for anything and ? for one letter; empty: all, if "
                   "they are of one kind",
                   any()},
                  {"recording.check_calibration", &s.check_calibration, "",
                   "euroc: whether [camera] must agree with cam0/sensor.yaml", any()},
                  {"recording.robot", &s.robot, "", "mrclam: which of the five", between(1, 5)},
                  {"recording.team", &s.team, "", "mrclam: all five in one belief", any()},
              });
}

/// The parameters declared by the motion models. Models with a common parameter share its key.
void motion_parameters(List& list, VehicleSettings& s) {
  const std::size_t first = list.size();
  for (const MotionEntry& motion : registered_motions())
    for (const ParameterInfo& p : motion.parameters) {
      const std::string key = "vehicle." + p.quantity.key();
      const auto has_key = [&](const Setting& setting) { return setting.key == key; };
      if (std::any_of(list.begin() + static_cast<std::ptrdiff_t>(first), list.end(), has_key)) continue;
      list.push_back({key, &s.parameter(p.quantity.key(), p.default_value), std::string(p.quantity.unit),
                      std::string(p.help), within(p.range)});
    }
}

void vehicle(List& list, VehicleSettings& s) {
  list.push_back(
      {"vehicle.model", &s.model, "", "how it moves, and what its odometry means", one_of(motion_names())});
  motion_parameters(list, s);
  list.insert(list.end(), {
                              {"vehicle.sigma_speed_m_s", &s.sigma_speed_m_s, "m/s",
                               "of the speed told, held for one reading", between(0, 1000)},
                              {"vehicle.sigma_steering_rad", &s.sigma_steering_rad, "rad",
                               "of the steering angle told, likewise", between(0, 3.2)},
                              {"vehicle.sigma_turn_rate_rad_s", &s.sigma_turn_rate_rad_s, "rad/s",
                               "of the turn rate told, likewise", between(0, 1000)},
                          });
}

void vehicle_start(List& list, PlanarStartSettings& s) {
  list.insert(
      list.end(),
      {
          {"vehicle_start.position_m", &s.position_m, "m", "of the sensor, in the world", between(-1e9, 1e9)},
          {"vehicle_start.heading_rad", &s.heading_rad, "rad", "about z, from +x", between(-6.3, 6.3)},
          {"vehicle_start.at_first_fix", &s.at_first_fix, "",
           "the position is the first that an external sensor tells, as GPS", any()},
          {"vehicle_start.sigma_position_m", &s.sigma_position_m, "m", "per axis", between(0, 1e6)},
          {"vehicle_start.sigma_heading_rad", &s.sigma_heading_rad, "rad", "of the above", between(0, 6.3)},
      });
}

void vehicle_filter(List& list, PlanarFilterSettings& s) {
  list.insert(
      list.end(),
      {
          {"vehicle_filter.lineariser", &s.linearization, "", "which Kalman filter",
           one_of({"analytic", "iterated", "unscented-vehicle", "first-estimate"})},
          {"vehicle_filter.map_frame", &s.map_frame, "", "where landmarks are told",
           one_of({"world", "vehicle"})},
          {"vehicle_filter.decorrelate", &s.decorrelate, "",
           "correlations dropped after each scan, covariances inflated by what that takes",
           one_of({"nothing", "everything", "map", "map-linear"})},
          {"vehicle_filter.anchors_m", &s.anchors, "m", "known landmarks, [x, y] each", between(-1e9, 1e9)},
          {"vehicle_filter.use_fixes", &s.use_fixes, "",
           "an external sensor, such as GPS, is used all along and not only for the start", any()},
          {"vehicle_filter.sigma_fix_m", &s.sigma_fix_m, "m", "of the external sensor, per axis",
           above_up_to(0, 1e6)},
      });
}

void vehicle_lost(List& list, PlanarLostSettings& s) {
  list.insert(list.end(),
              {
                  {"vehicle_lost.max_sigma_position_m", &s.max_sigma_position_m, "m",
                   "beyond, lost whatever matches", more_than(0)},
                  {"vehicle_lost.max_unmatched_scans", &s.max_unmatched_scans, "",
                   "scans in a row that show landmarks, none of them known: lost", between(1, 100000)},
              });
}

void ranges(List& list, RangeBearingSettings& s) {
  list.insert(
      list.end(),
      {
          {"ranges.sigma_range_m", &s.sigma_range_m, "m", "of one range", above_up_to(0, 1000)},
          {"ranges.sigma_range_ratio", &s.sigma_range_ratio, "", "times the range, added to it",
           between(0, 1)},
          {"ranges.sigma_bearing_rad", &s.sigma_bearing_rad, "rad", "of one bearing", above_up_to(0, 3.2)},
          {"ranges.max_range_m", &s.max_range_m, "m", "farther detections are left out", above_up_to(0, 1e6)},
      });
}

void association(List& list, DataAssociationSettings& s) {
  list.insert(list.end(),
              {
                  {"association.method", &s.method, "",
                   "known: by what the sensor says; nearest: neighbour in its gate; joint: compatibility "
                   "branch and bound",
                   one_of({"known", "nearest", "joint"})},
                  {"association.gate_probability", &s.gate_probability, "",
                   "of a right pairing being inside its gate", between(0.5, 0.999999999)},
                  {"association.max_nodes", &s.max_nodes, "", "of the joint search; said when it is reached",
                   between(1, 1e9)},
                  {"association.birth_probability", &s.initialization_probability, "",
                   "what is outside this gate of every landmark is a new one", between(0.5, 0.999999999)},
                  {"association.birth_distance_m", &s.initialization_distance_m, "m",
                   "and at least so far from every landmark", at_least(0)},
              });
}

void start(List& list, StartSettings& s) {
  list.insert(list.end(),
              {
                  {"start.from", &s.from, "",
                   "target: pose solved from the known target; free: here is the origin", words(s.from)},
                  {"start.target", &s.target, "",
                   "target file, found beside the scenario or under the data folder", any()},
                  {"start.max_search_s", &s.max_search_s, "s",
                   "give up when the target was not found by then", above_up_to(0, 1e6)},
              });
}

void filter(List& list, FilterSettings& s) {
  list.insert(list.end(),
              {
                  {"filter.sigma_acceleration_m_s2", &s.sigma_acceleration_m_s2, "m/s^2",
                   "unknown linear acceleration per axis, held for one frame", between(0, 1e4)},
                  {"filter.sigma_angular_acceleration_rad_s2", &s.sigma_angular_acceleration_rad_s2,
                   "rad/s^2", "unknown angular acceleration per axis, held for one frame", between(0, 1e4)},
                  {"filter.sigma_pixel_px", &s.sigma_pixel_px, "px",
                   "of one measured patch position, per axis", between(0.001, 100)},
                  {"filter.sigma_start_velocity_m_s", &s.sigma_start_velocity_m_s, "m/s",
                   "per axis, when the run starts", between(0, 1e4)},
                  {"filter.sigma_start_angular_rate_rad_s", &s.sigma_start_angular_rate_rad_s, "rad/s",
                   "per axis, when the run starts", between(0, 1e4)},
                  {"filter.odometry", &s.odometry, "",
                   "of a camera on a vehicle: whether what the wheels tell is used", any()},
                  {"filter.sigma_slip_m_s", &s.sigma_slip_m_s, "m/s",
                   "odometry: how far the vehicle moves otherwise than its wheels say, per axis",
                   above_up_to(0, 100)},
              });
}

void search(List& list, SearchSettings& s) {
  list.insert(
      list.end(),
      {
          {"search.patch_size_px", &s.patch_size_px, "px", "side of the square compared", odd_between(9, 15)},
          {"search.gate_sigmas", &s.gate_sigmas, "",
           "half axes of the search ellipse in standard deviations of the innovation", above_up_to(0, 100)},
          {"search.min_correlation", &s.min_correlation, "",
           "normalised cross-correlation below which nothing was found", between(-1, 1)},
          {"search.max_measurements", &s.max_measurements, "",
           "looks searched for in a frame, most uncertain first", between(1, 10000)},
          {"search.max_half_axis_px", &s.max_half_axis_px, "px",
           "an ellipse is searched no further out than this", above_up_to(0, 16384)},
          {"search.gate_probability", &s.gate_probability, "",
           "of a right match passing each consistency test", between(0.5, 0.999999)},
          {"search.max_alone_sigma_px", &s.max_unconfirmed_sigma_px, "px",
           "what returns is not believed where the other matches say no more than that it is within this",
           above_up_to(0, 1e9)},
      });
}

void initialization(List& list, InitializationSettings& s) {
  list.insert(
      list.end(),
      {
          {"birth.method", &s.method, "", "how a new feature is represented", words(s.method)},
          {"birth.centre", &s.center, "",
           "of a patch: `edges`, where they meet, or `peak`, of the corner measure", words(s.center)},
          {"birth.box_width_px", &s.box_width_px, "px", "of the box a new feature is looked for in",
           between(16, 16384)},
          {"birth.box_height_px", &s.box_height_px, "px", "of the box a new feature is looked for in",
           between(16, 16384)},
          {"birth.min_corner_strength", &s.min_corner_strength, "grey^2/px",
           "smaller eigenvalue of the structure tensor", at_least(0)},
          {"birth.look_ahead_s", &s.look_ahead_s, "s",
           "a corner about to leave the view within this time is not taken", between(0, 100)},
          {"birth.max_new_per_frame", &s.max_new_per_frame, "", "new features in one frame",
           between(0, 1000)},
          {"birth.sigma_slope", &s.sigma_slope, "",
           "tangent of a patch's tilt, per axis, before it is learnt; 0: it faces the camera",
           between(0, 10)},
          {"birth.particles", &s.particles, "", "depth-line: depths tried on the line of sight",
           between(2, 100000)},
          {"birth.min_depth_m", &s.min_depth_m, "m",
           "nearest depth a new feature may have: of the line, and to judge whether it stays in view",
           above_up_to(0, 1e6)},
          {"birth.max_depth_m", &s.max_depth_m, "m",
           "farthest depth a new feature may have: of the line, and to judge whether it stays in view",
           above_up_to(0, 1e6)},
          {"birth.depth_ratio", &s.depth_ratio, "",
           "depth-line: sigma/depth below which a line becomes a point", above_up_to(0, 1)},
          {"birth.max_line_failures", &s.max_line_failures, "",
           "depth-line: attempts after which a line without a point is given up", between(1, 10000)},
          {"birth.inverse_depth_per_m", &s.inverse_depth_per_m, "1/m",
           "inverse-depth: mean before anything is known", between(1e-6, 1000)},
          {"birth.sigma_inverse_depth_per_m", &s.sigma_inverse_depth_per_m, "1/m",
           "inverse-depth: standard deviation before anything is known", above_up_to(0, 1000)},
          {"birth.max_linearity", &s.max_linearity, "",
           "inverse-depth: Civera's index below which it becomes a point", between(0, 10)},
      });
}

void map(List& list, MapSettings& s) {
  list.insert(
      list.end(),
      {
          {"map.wanted_visible", &s.wanted_visible, "",
           "new features are looked for while fewer are expected in view", between(0, 10000)},
          {"map.max_landmarks", &s.max_landmarks, "", "a hard cap on what is mapped", between(1, 10000)},
          {"map.max_view_angle_rad", &s.max_view_angle_rad, "rad",
           "from the view a patch was taken at; beyond, it is not expected to match", above_up_to(0, 3.2)},
          {"map.max_scale", &s.max_scale, "", "how much nearer or farther than at birth a patch may be seen",
           above_up_to(1, 100)},
          {"map.min_attempts", &s.min_attempts, "", "before a landmark can be judged", between(1, 100000)},
          {"map.min_matched_share", &s.min_matched_share, "",
           "of its attempts, below which a landmark is deleted", between(0, 1)},
      });
}

void lost(List& list, LostSettings& s) {
  list.insert(list.end(), {
                              {"lost.min_matches", &s.min_matches, "",
                               "a frame with fewer counts towards being lost", between(3, 10000)},
                              {"lost.max_frames", &s.max_frames, "", "so many such frames in a row: lost",
                               between(1, 100000)},
                              {"lost.max_sigma_position_m", &s.max_sigma_position_m, "m",
                               "beyond, lost whatever matches", more_than(0)},
                          });
}

void control(List& list, ControlSettings& s) {
  list.insert(
      list.end(),
      {
          {"control.gain_position_per_s2", &s.gain_position_per_s2, "1/s^2", "on the position error",
           at_least(0)},
          {"control.gain_velocity_per_s", &s.gain_velocity_per_s, "1/s", "on the velocity", at_least(0)},
          {"control.gain_orientation_per_s2", &s.gain_orientation_per_s2, "1/s^2", "holds the gaze",
           at_least(0)},
          {"control.gain_rate_per_s", &s.gain_rate_per_s, "1/s", "on the angular rate", at_least(0)},
          {"control.max_acceleration_m_s2", &s.max_acceleration_m_s2, "m/s^2",
           "per axis, what the body can do", at_least(0)},
          {"control.max_angular_acceleration_rad_s2", &s.max_angular_acceleration_rad_s2, "rad/s^2",
           "per axis, what the body can do", at_least(0)},
          {"control.gaze_amplitude_rad", &s.gaze_amplitude_rad, "rad",
           "the gaze swings by this much to either side about the vertical", between(0, 3.2)},
          {"control.gaze_period_s", &s.gaze_period_s, "s", "of one full swing", between(0.001, 1e6)},
      });
}

void operator_checks(List& list, OperatorSettings& s) {
  list.insert(
      list.end(),
      {
          {"person.holds", &s.holds, "",
           "a person moves the camera by hand as the screen says; nobody tells the filter", any()},
          {"person.delay_s", &s.delay_s, "s", "from what is shown to what is done", between(0, 100)},
          {"person.wrong", &s.wrong, "", "probability that another of the six ways is gone", between(0, 1)},
          {"person.sigma_way_ratio", &s.sigma_way_ratio, "", "of how far is gone, over how far was shown",
           between(0, 10)},
      });
}

void room(List& list, RoomSettings& s) {
  list.insert(
      list.end(),
      {
          {"room.size_m", &s.size_m, "m", "the room spans +-x/2, +-y/2, and 0 to z", between(1.8, 50)},
          {"room.boxes", &s.boxes, "", "textured boxes standing on the floor along the walls",
           between(0, 24)},
          {"room.start_position_m", &s.start_position_m, "m",
           "camera at t = 0; it looks along +x, at the target", between(-1000, 1000)},
          {"room.start_heading_rad", &s.start_heading_rad, "rad", "about z, from +x", between(-6.3, 6.3)},
          {"room.sigma_start_position_m", &s.sigma_start_position_m, "m",
           "the true start is drawn around the above", between(0, 10)},
          {"room.sigma_start_heading_rad", &s.sigma_start_heading_rad, "rad",
           "the true start is drawn around the above", between(0, 3.2)},
          {"room.sigma_image_grey", &s.sigma_image_gray, "grey", "image noise", between(0, 100)},
          {"room.sigma_acceleration_m_s2", &s.sigma_acceleration_m_s2, "m/s^2",
           "true disturbance per axis, held for one frame", between(0, 1000)},
          {"room.sigma_angular_acceleration_rad_s2", &s.sigma_angular_acceleration_rad_s2, "rad/s^2",
           "true disturbance per axis, held for one frame", between(0, 1000)},
          {"room.clearance_m", &s.clearance_m, "m",
           "the camera's body, or the middle of its vehicle's axle, stops this far from walls and boxes",
           between(0, 0.5)},
          {"room.cover_lens_from_s", &s.cover_lens_from_s, "s",
           "the lens is covered from then on; never when negative", any()},
      });
}

}  // namespace

std::vector<Setting> list_settings(Scenario& scenario) {
  List list;
  run(list, scenario.run);
  camera(list, scenario.camera);
  recording(list, scenario.recording);
  start(list, scenario.start);
  filter(list, scenario.slam.filter);
  search(list, scenario.slam.search);
  initialization(list, scenario.slam.initialization);
  map(list, scenario.slam.map);
  lost(list, scenario.slam.lost);
  list_decision_settings(list, scenario.decision, scenario.exploration);
  control(list, scenario.control);
  operator_checks(list, scenario.operator_settings);
  room(list, scenario.room);
  vehicle(list, scenario.planar.vehicle);
  vehicle_start(list, scenario.planar.start);
  vehicle_filter(list, scenario.planar.filter);
  vehicle_lost(list, scenario.planar.lost);
  ranges(list, scenario.planar.sensor);
  association(list, scenario.planar.association);
  list_team_settings(list, scenario.team);
  return list;
}

namespace {

bool section_applies(const std::string& section, const std::string& sensor) {
  static const std::vector<std::string> always{"run", "recording"};
  static const std::vector<std::string> ranging{"vehicle",      "vehicle_start", "vehicle_filter",
                                                "vehicle_lost", "ranges",        "association"};
  const auto has = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), section) != list.end();
  };
  return has(always) || has(ranging) == (sensor == "range-bearing");
}

}  // namespace

namespace {

/// Whether the key belongs to the decision of a vehicle that carries the camera.
bool of_speeds(const std::string& key) {
  return key == "decision.acceleration_m_s2" || key == "decision.turn_acceleration_rad_s2" ||
         key == "decision.impulse_s" || key == "decision.accelerations";
}

}  // namespace

namespace {

/// Why a key of image recordings is inapplicable, given the recording format.
std::string why_no_images(const std::string& key, const Scenario& s) {
  const char* format = key == "recording.pattern"             ? "images"
                       : key == "recording.check_calibration" ? "euroc"
                                                              : nullptr;
  if (!format) return "";
  if (s.run.sensor != "camera") return "run.sensor = `" + s.run.sensor + "`";
  const std::string& given = s.recording.format;
  return given == "auto" || given == format ? "" : "recording.format = `" + given + "`";
}

}  // namespace

std::string inapplicable_reason(const std::string& key, const Scenario& s) {
  if (is_team(s)) return inapplicable_to_team(key, s);
  if (is_room_vehicle(s)) return inapplicable_to_room_vehicle(key, s);
  if (key == "filter.odometry" || key == "filter.sigma_slip_m_s") return "a camera that is on no vehicle";
  if (const std::string why = why_no_images(key, s); !why.empty()) return why;
  if (is_team_section(section_of(key))) return "run.world = `" + s.run.world + "`";
  if (!section_applies(section_of(key), s.run.sensor)) return "run.sensor = `" + s.run.sensor + "`";
  if (section_of(key) == "person") {
    if (s.run.world == "recording") return "run.world = `recording`";
    return s.operator_settings.holds || key == "person.holds" ? "" : "person.holds = false";
  }
  if (s.run.sensor != "range-bearing") return of_speeds(key) ? "a camera that flies" : "";
  const auto any_of = [&](std::initializer_list<const char*> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  const std::string model = "vehicle.model = `" + s.planar.vehicle.model + "`";
  if (section_of(key) == "vehicle" && !applies_to_motion(name_in_section(key), s.planar.vehicle.model))
    return model;
  const std::string& method = s.planar.association.method;
  if (method != "joint" && key == "association.max_nodes") return "association.method = `" + method + "`";
  if (method == "known" && any_of({"association.birth_probability", "association.birth_distance_m"}))
    return "association.method = `known`";
  if (!s.planar.filter.use_fixes && key == "vehicle_filter.sigma_fix_m")
    return "vehicle_filter.use_fixes = false";
  if (key == "run.rate_hz" && s.run.world == "recording") return "a recording, which has its own times";
  const std::string& format = s.recording.format;
  if (key == "recording.robot" && format != "mrclam" && format != "auto")
    return "recording.format = `" + format + "`";
  return "";
}

std::vector<Setting> settings_in_force(Scenario& scenario) {
  List list = list_settings(scenario);
  std::erase_if(list,
                [&](const Setting& setting) { return !inapplicable_reason(setting.key, scenario).empty(); });
  return list;
}

std::string section_of(const std::string& key) { return key.substr(0, key.find('.')); }

std::string name_in_section(const std::string& key) { return key.substr(key.find('.') + 1); }

}  // namespace incognita
