#include "incognita/io/scenario/scenario_tree.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using Law = ControlLaw;
using Method = DataAssociationSettings::Method;
using Words = std::vector<std::string>;

/// The properties of the choices that the settings of simulated and recorded vehicles depend on.
struct Bodies {
  const MotionTraits& motion;
  const SensorTraits& sensor;
  bool camera = sensor.dimensions == 3;
  bool in_space = motion.in_space(), line = motion.on_line();
  bool drives = motion.has_input("speed"), turns = motion.has_input("turn_rate"),
       steers = motion.has_input("steering");
};

Bodies bodies_of(const Scenario& s) { return {s.motion(), s.measured()}; }

// ------------------------------------------------------------------------------------------------ parts of all worlds

void run(SettingReader& r, Scenario& s, bool has_rate, bool is_observed) {
  r.section("run");
  if (has_rate) r.some(s.run, &RunSettings::rate_hz);
  if (is_observed) r.some(s.run, &RunSettings::observability);
  r.some(s.run, &RunSettings::entropy, &RunSettings::save_every_s);
}

void sensor_type(SettingReader& r, Scenario& s, const Words& words) {
  r.section("sensor");
  s.sensor.type = words.front();
  r.choice(s.sensor, &SensorSettings::type, words);
}

void vehicle_model(SettingReader& r, Scenario& s, const Words& words) {
  r.section("vehicle");
  if (std::find(words.begin(), words.end(), s.planar.vehicle.model) == words.end())
    s.planar.vehicle.model = words.front();
  r.choice(s.planar.vehicle, &VehicleSettings::model, words);
}

/// Parameters of the motion model, and the noise of its inputs.
void vehicle(SettingReader& r, Scenario& s) {
  r.section("vehicle");
  VehicleSettings& v = s.planar.vehicle;
  const MotionTraits& motion = s.motion();
  for (const MotionEntry& entry : registered_motions())
    if (entry.traits.name == motion.name)
      for (const ParameterInfo& p : entry.parameters)
        r.parameter(v.parameters.emplace(p.quantity.key(), p.default_value).first->second, p);
  if (motion.has_input("speed")) r.some(v, &VehicleSettings::sigma_speed_m_s);
  if (motion.has_input("turn_rate")) r.some(v, &VehicleSettings::sigma_turn_rate_rad_s);
  if (motion.has_input("steering")) r.some(v, &VehicleSettings::sigma_steering_rad);
}

/// Unknown accelerations of a body in space.
void accelerations(SettingReader& r, Scenario& s) {
  r.section("vehicle");
  r.some(s.slam.filter, &FilterSettings::sigma_acceleration_m_s2,
         &FilterSettings::sigma_angular_acceleration_rad_s2);
}

void terrain(SettingReader& r, Scenario& s) {
  r.section("terrain");
  r.alternative(s.terrain, &TerrainSettings::type);
}

void mount(SettingReader& r, Scenario& s) {
  r.section("mount");
  r.parameters(s.mount);
}

void decision(SettingReader& r, Scenario& s, bool accelerates) {
  using D = DecisionSettings;
  DecisionSettings& d = s.decision;
  r.section("decision");
  r.some(d, &D::strategy, &D::metric, &D::horizon, &D::max_evaluations, &D::schedule, &D::sequence,
         &D::lane_m, &D::wall_distance_m, &D::held_periods, &D::views_per_period, &D::resolution_m,
         &D::max_elevation_rad, &D::discount_s, &D::prepare_s, &D::min_matches, &D::pose_weight, &D::period_s,
         &D::min_bound_m, &D::max_bound_m);
  if (!accelerates) {
    r.some(d, &D::step_m, &D::moves_m);
  } else {
    r.some(d, &D::impulse_s, &D::accelerations);
    if (d.accelerations.empty()) r.some(d, &D::acceleration_m_s2, &D::turn_acceleration_rad_s2);
  }
  r.section("exploration");
  using E = ExplorationSettings;
  r.some(s.exploration, &E::expected_landmarks, &E::variance_expected_m2, &E::min_m, &E::max_m, &E::cell_m,
         &E::seen_s, &E::placed, &E::side_cell_m, &E::patience_s);
}

/// The rotation of a free camera.
void gaze(SettingReader& r, Scenario& s) {
  r.section("decision");
  using D = DecisionSettings;
  r.some(s.decision, &D::gaze, &D::gaze_rate_rad_s, &D::gaze_period_s, &D::gaze_ahead_s);
}

void operator_model(SettingReader& r, Scenario& s) {
  r.section("operator");
  using O = OperatorSettings;
  r.some(s.operator_settings, &O::holds);
  if (s.operator_settings.holds) r.some(s.operator_settings, &O::delay_s, &O::wrong, &O::sigma_way_ratio);
}

void association(SettingReader& r, Scenario& s) {
  r.section("association");
  using A = DataAssociationSettings;
  A& a = s.planar.association;
  r.some(a, &A::method);
  // Sensors of a simulation report identities. Without, gates are wide: the initial depth is a guess, and a gated
  // re-detection would be initialized as a duplicate landmark.
  if (s.is_simulated() && a.method == Method::known) a.gate_probability = 1;
  r.some(a, &A::gate_probability);
  if (a.method == Method::joint) r.some(a, &A::max_nodes);
  if (a.method != Method::known) r.some(a, &A::initialization_probability, &A::initialization_distance_m);
}

/// Deletion of landmarks that have no identity. Recordings hold spurious detections, which simulations do not.
void pruning(SettingReader& r, Scenario& s) {
  if (s.planar.association.method == Method::known) return;
  r.section("map");
  if (s.is_recording()) s.planar.pruning.min_detected_share = 0.1;
  r.all(s.planar.pruning);
}

/// Noise that the estimator assumes for ranges and bearings.
void ranges(SettingReader& r, Scenario& s, const Bodies& b) {
  r.section("sensor");
  using R = RangeBearingSettings;
  if (b.sensor.measures("range")) r.some(s.planar.sensor, &R::sigma_range_m, &R::sigma_range_ratio);
  if (!b.line) r.some(s.planar.sensor, &R::sigma_bearing_rad);
  r.some(s.planar.sensor, &R::max_range_m);
}

/// Limits of the estimate from point sensors.
void point_health(SettingReader& r, HealthSettings& health) {
  using H = HealthSettings;
  r.section("health");
  r.some(health, &H::max_sigma_position_m, &H::max_sigma_ratio, &H::max_ticks, &H::max_innovation_sigmas,
         &H::min_expected);
}

/// Limits of the estimate from images.
void image_health(SettingReader& r, HealthSettings& health) {
  using H = HealthSettings;
  r.section("health");
  health.max_sigma_position_m = H{}.max_sigma_position_m;
  r.some(health, &H::max_sigma_position_m, &H::max_sigma_ratio, &H::max_ticks, &H::max_innovation_sigmas,
         &H::min_matches, &H::min_matched_share, &H::min_matches_to_relocate, &H::sigma_search_position_m,
         &H::sigma_search_rotation_rad);
  r.follower(health, &H::sigma_search_velocity_m_s, "start.sigma_velocity_m_s");
  r.follower(health, &H::sigma_search_rate_rad_s, "start.sigma_angular_rate_rad_s");
}

// ------------------------------------------------------------------------------------------------ estimation from images

void landmark_initialization(SettingReader& r, InitializationSettings& i) {
  using I = InitializationSettings;
  r.section("landmark_initialization");
  r.some(i, &I::method, &I::selection);
  if (i.selection == I::Selection::random_box) r.some(i, &I::box_width_px, &I::box_height_px);
  r.some(i, &I::min_corner_strength, &I::center, &I::look_ahead_s, &I::sigma_slope, &I::max_new_per_frame);
  if (i.selection == I::Selection::random_box || i.method == I::Method::depth_line)
    r.some(i, &I::min_depth_m, &I::max_depth_m);
  if (i.method == I::Method::depth_line)
    r.some(i, &I::particles, &I::depth_ratio, &I::max_line_failures);
  else
    r.some(i, &I::inverse_depth_per_m, &I::sigma_inverse_depth_per_m, &I::scale_prior_to_view,
           &I::max_linearity, &I::second_order);
}

void image_estimator(SettingReader& r, Scenario& s) {
  r.section("start");
  r.some(s.start, &StartSettings::from);
  if (s.start.from == StartSettings::From::target)
    r.some(s.start, &StartSettings::target, &StartSettings::max_search_s);
  r.some(s.slam.filter, &FilterSettings::sigma_start_velocity_m_s,
         &FilterSettings::sigma_start_angular_rate_rad_s);
  accelerations(r, s);
  r.section("sensor");
  r.some(s.slam.filter, &FilterSettings::sigma_pixel_px, &FilterSettings::adapt_sigma_pixel,
         &FilterSettings::sigma_lasting_px, &FilterSettings::lasting_time_s);
  r.section("search");
  r.all(s.slam.search);
  landmark_initialization(r, s.slam.initialization);
  if (s.slam.initialization.method != InitializationSettings::Method::depth_line) {
    r.section("estimator");
    r.some(s.slam.filter, &FilterSettings::invariant);
  }
  r.section("map");
  r.all(s.slam.map);
  r.section("bundle");
  r.all(s.slam.bundle);
  r.section("relocalization");
  r.all(s.slam.relocalization);
  image_health(r, s.slam.health);
}

/// Decision of a free camera that sees images.
void free_camera_decision(SettingReader& r, Scenario& s) {
  decision(r, s, false);
  gaze(r, s);
  r.section("exploration");
  r.some(s.exploration, &ExplorationSettings::counted);
}

// ------------------------------------------------------------------------------------------------ control of vehicles

void path(SettingReader& r, Scenario& s, bool in_space) {
  r.section("path");
  using P = PathSettings;
  r.some(s.path, &P::type);
  if (auto* point = std::get_if<PointPath>(&s.path.type); point && !in_space)
    r.some(*point, &PointPath::position);
  else
    std::visit([&](auto& chosen) { r.all(chosen); }, s.path.type);
  if (s.is_team()) r.some(s.path, &P::offsets_m);
}

Words laws(const Scenario& s) {
  if (s.has_carried_camera()) return {word_of(Law::none), word_of(Law::active)};
  Words words;
  for (const auto& [law, word] : enum_words<Law>)
    if (law != Law::lqg || !s.is_camera_vehicle()) words.emplace_back(word);
  return words;
}

/// Gains of the chosen law.
void gains(SettingReader& r, Scenario& s, const Bodies& b) {
  const Law law = s.controller.law;
  LawSettings::used_by(law, b.motion, [&](auto member) { r.some(s.law_settings, member); });
  using G = ControlSettings;
  if (b.in_space && law != Law::none && law != Law::lqg)
    r.some(s.control, &G::gain_position_per_s2, &G::gain_velocity_per_s, &G::gain_orientation_per_s2,
           &G::gain_rate_per_s);
}

/// Controller with path or decision.
void controller(SettingReader& r, Scenario& s, const Bodies& b) {
  using C = ControllerSettings;
  using G = ControlSettings;
  C& c = s.controller;
  const bool carried = s.has_carried_camera();
  r.section("controller");
  r.choice(c, &C::law, laws(s));
  if (c.law == Law::none) r.some(c, &C::input);
  if (!b.in_space || carried) r.some(c, &C::max_speed_m_s);
  if (b.turns || carried) r.some(c, &C::max_turn_rate_rad_s);
  if (b.steers) r.some(c, &C::max_steering_rad);
  if (b.in_space && !carried && c.law != Law::none)
    r.some(s.control, &G::max_acceleration_m_s2, &G::max_angular_acceleration_rad_s2);
  if (!carried) gains(r, s, b);
  if (s.is_room_vehicle()) r.some(c, &C::avoidance_distance_m);
  if (c.law != Law::none && c.law != Law::active) path(r, s, b.in_space);
  if (c.law != Law::active) return;
  decision(r, s, carried || s.is_camera_vehicle());
  if (b.in_space && !carried) {
    s.decision.gaze = DecisionSettings::Gaze::hold;
    gaze(r, s);
    r.section("controller");
    if (s.decision.gaze == DecisionSettings::Gaze::swing)
      r.some(s.control, &G::gaze_amplitude_rad, &G::gaze_period_s);
  }
  if (s.is_camera_vehicle()) r.section("exploration"), r.some(s.exploration, &ExplorationSettings::counted);
  if (b.in_space && !carried) operator_model(r, s);
}

// ------------------------------------------------------------------------------------------------ worlds

/// The true disturbance of the wheels.
void wheels(SettingReader& r, Scenario& s, bool follow) {
  using P = TruePlantSettings;
  r.follower(s.plant, &P::sigma_speed_m_s, follow ? "vehicle.sigma_speed_m_s" : "");
  r.some(s.plant, &P::speed_ratio);
  r.follower(s.plant, &P::sigma_turn_rate_rad_s, follow ? "vehicle.sigma_turn_rate_rad_s" : "");
  r.some(s.plant, &P::turn_ratio);
}

void room_vehicle(SettingReader& r, Scenario& s) {
  using P = TruePlantSettings;
  using F = FilterSettings;
  vehicle(r, s);
  r.section("start");
  r.some(s.team_start, &TeamStartSettings::positions_m, &TeamStartSettings::headings_rad);
  r.section("estimator");
  r.some(s.slam.filter, &F::odometry);
  if (s.slam.filter.odometry) r.some(s.slam.filter, &F::sigma_slip_m_s);
  r.section("plant");
  r.some(s.plant, &P::sigma_start_position_m, &P::sigma_start_heading_rad);
  wheels(r, s, false);
  terrain(r, s);
  mount(r, s);
  controller(r, s, bodies_of(s));
}

/// A calibration replaces the defaults: that of `camera.file`, or of a recording without [camera].
void camera(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  const bool of_recording = s.world.type == WorldSettings::Type::recording && !r.has_given("camera");
  r.section("camera");
  r.some(s.camera, &CameraSettings::file);
  if (find_camera && (of_recording || !s.camera.file.empty())) try {
      if (auto found = find_camera(s)) {
        found->camera.file = s.camera.file;
        s.camera = found->camera;
        r.defaults_are(found->source);
      }
    } catch (const InputError& error) {
      if (s.camera.file.empty()) throw;
      r.refuse("camera.file", error.what());
    }
  read_camera(r, s.camera);
  r.defaults_are("default");
}

/// A robot that carries a camera. Its own side avoids obstacles.
void robot(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  using F = FilterSettings;
  vehicle_model(r, s, {"terrain"});
  sensor_type(r, s, {"camera"});
  run(r, s, true, true);
  r.section("robot");
  r.all(s.robot);
  camera(r, s, find_camera);
  image_estimator(r, s);
  vehicle(r, s);
  r.section("estimator");
  r.some(s.slam.filter, &F::odometry);
  if (s.slam.filter.odometry) r.some(s.slam.filter, &F::sigma_slip_m_s);
  mount(r, s);
  controller(r, s, bodies_of(s));
}

/// A target is in view only of a camera that starts at it, so the start of a recorded motion is free unless it is given.
void room_motion(SettingReader& r, Scenario& s) {
  r.section("motion");
  r.some(s.true_motion, &MotionSettings::type);
  auto* trajectory = std::get_if<TrajectoryMotion>(&s.true_motion.type);
  if (!trajectory) return;
  r.some(*trajectory, &TrajectoryMotion::file, &TrajectoryMotion::start_s);
  r.alternative(*trajectory, &TrajectoryMotion::axes);
  s.start.from = StartSettings::From::free;
}

void exposure(SettingReader& r, ExposureSettings& e) {
  using E = ExposureSettings;
  r.section("exposure");
  r.some(e, &E::duration_s, &E::readout_s, &E::step_ratio, &E::step_times_s);
  if (e.step_times_s.empty()) r.some(e, &E::step_interval_s);
}

void room(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  using R = RoomSettings;
  vehicle_model(r, s, {"free-camera", "terrain"});
  sensor_type(r, s, {"camera"});
  run(r, s, true, true);
  r.section("room");
  r.some(s.room, &R::size_m, &R::boxes, &R::texel_m, &R::sigma_image_gray, &R::clearance_m,
         &R::cover_lens_from_s);
  exposure(r, s.exposure);
  camera(r, s, find_camera);
  if (!s.is_room_vehicle()) room_motion(r, s);
  image_estimator(r, s);
  if (s.is_room_vehicle()) return room_vehicle(r, s);
  r.section("room");
  r.some(s.room, &R::start_position_m, &R::start_heading_rad);
  if (s.has_recorded_motion()) return free_camera_decision(r, s);  // as of recorded images
  r.section("plant");
  r.some(s.room, &R::sigma_start_position_m, &R::sigma_start_heading_rad, &R::sigma_acceleration_m_s2,
         &R::sigma_angular_acceleration_rad_s2);
  free_camera_decision(r, s);
  r.section("controller");
  r.all(s.control);
  operator_model(r, s);
}

void recorded_images(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  using R = RecordingSettings;
  using Format = R::Format;
  const Format format = s.recording.format;
  vehicle_model(r, s, {"free-camera"});
  run(r, s, true, true);
  r.section("recording");
  if (format == Format::images || format == Format::automatic) r.some(s.recording, &R::pattern);
  if (format == Format::euroc || format == Format::kitti || format == Format::bag ||
      format == Format::automatic)
    r.some(s.recording, &R::check_calibration);
  if (format == Format::bag || format == Format::automatic)
    r.some(s.recording, &R::image_topic, &R::truth_topic);
  r.some(s.recording, &R::truth, &R::truth_offset_s, &R::truth_frame);
  camera(r, s, find_camera);
  image_estimator(r, s);
  free_camera_decision(r, s);  // shown as advice: nothing controls the recorded motion
}

/// A camera that an operator holds, or that stands still.
void live_camera(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  vehicle_model(r, s, {"free-camera"});
  sensor_type(r, s, {"camera"});
  run(r, s, true, true);
  r.section("live");
  r.all(s.live);
  camera(r, s, find_camera);
  image_estimator(r, s);
  free_camera_decision(r, s);  // shown to the operator
}

void recorded_vehicle(SettingReader& r, Scenario& s) {
  using P = PlanarStartSettings;
  using F = PlanarFilterSettings;
  vehicle_model(r, s, {"ackermann", "differential-drive"});
  run(r, s, false, true);
  vehicle(r, s);
  ranges(r, s, bodies_of(s));
  r.section("start");
  r.some(s.planar.start, &P::at_first_fix);
  if (!s.planar.start.at_first_fix) r.some(s.planar.start, &P::position_m);
  r.some(s.planar.start, &P::heading_rad, &P::sigma_position_m, &P::sigma_heading_rad);
  r.section("estimator");
  r.some(s.planar.filter, &F::linearization, &F::map_frame, &F::decorrelate, &F::anchors, &F::use_fixes);
  if (s.planar.filter.use_fixes) r.some(s.planar.filter, &F::sigma_fix_m);
  association(r, s);
  pruning(r, s);
  point_health(r, s.planar.health);
}

void recorded_team(SettingReader& r, Scenario& s) {
  using T = TeamStartSettings;
  vehicle_model(r, s, {"differential-drive"});
  run(r, s, false, true);
  vehicle(r, s);
  ranges(r, s, bodies_of(s));
  r.some(s.sensor, &SensorSettings::measures_vehicles);
  r.section("start");
  r.some(s.team_start, &T::sigma_position_m, &T::sigma_heading_rad);
  r.section("estimator");
  r.some(s.planar.filter, &PlanarFilterSettings::linearization);
  r.all(s.belief);
  r.section("association");
  s.planar.association = {.method = Method::known, .gate_probability = 1};
  r.some(s.planar.association, &DataAssociationSettings::gate_probability);
  point_health(r, s.planar.health);
}

/// The sensors whose measurements are in recordings of that format.
Words sensors_in(RecordingSettings::Format format) {
  using Format = RecordingSettings::Format;
  if (format == Format::automatic) return {"camera", "range-bearing"};
  const bool ranges = format == Format::acfr || format == Format::mrclam || format == Format::tables;
  return {ranges ? "range-bearing" : "camera"};
}

void recording(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  using R = RecordingSettings;
  using Format = R::Format;
  r.section("recording");
  r.some(s.recording, &R::format, &R::folder);
  const bool may_be_team = s.recording.format == Format::automatic || s.recording.format == Format::mrclam;
  sensor_type(r, s, sensors_in(s.recording.format));
  if (s.sensor.type == "camera") return recorded_images(r, s, find_camera);
  r.section("recording");
  if (may_be_team) r.some(s.recording, &R::team);
  if (s.recording.team) return recorded_team(r, s);
  if (may_be_team) r.some(s.recording, &R::robot);
  recorded_vehicle(r, s);
}

void point_landmarks(SettingReader& r, PointsSettings& p) {
  using P = PointsSettings;
  r.section("points");
  r.some(p, &P::file, &P::known);
  if (p.file.empty()) r.some(p, &P::count, &P::size_m, &P::center_m);
}

/// True motion, start and noise. Standard deviations are those of the estimator unless they are given.
void plant(SettingReader& r, Scenario& s, const Bodies& b) {
  using P = TruePlantSettings;
  r.section("plant");
  const bool carried = s.has_carried_camera();
  r.follower(s.plant, &P::sigma_start_position_m, "start.sigma_position_m");
  if (b.in_space && !carried) r.follower(s.plant, &P::sigma_start_height_m, "start.sigma_height_m");
  if (!b.line) r.follower(s.plant, &P::sigma_start_heading_rad, "start.sigma_heading_rad");
  if (carried) {
    wheels(r, s, false);
  } else if (b.in_space) {
    r.follower(s.plant, &P::sigma_acceleration_m_s2, "vehicle.sigma_acceleration_m_s2");
    r.follower(s.plant, &P::sigma_angular_acceleration_rad_s2, "vehicle.sigma_angular_acceleration_rad_s2");
  } else {
    if (b.drives) r.follower(s.plant, &P::sigma_speed_m_s, "vehicle.sigma_speed_m_s");
    r.some(s.plant, &P::speed_ratio);
    if (b.turns) r.follower(s.plant, &P::sigma_turn_rate_rad_s, "vehicle.sigma_turn_rate_rad_s");
    if (b.steers) r.follower(s.plant, &P::sigma_steering_rad, "vehicle.sigma_steering_rad");
    if (b.turns || b.steers) r.some(s.plant, &P::turn_ratio);
  }
  if (b.sensor.measures("range")) {
    r.follower(s.plant, &P::sigma_range_m, "sensor.sigma_range_m");
    r.follower(s.plant, &P::sigma_range_ratio, "sensor.sigma_range_ratio");
  }
  if (!b.camera && !b.line) r.follower(s.plant, &P::sigma_bearing_rad, "sensor.sigma_bearing_rad");
  if (b.camera) r.follower(s.plant, &P::sigma_pixel_px, "sensor.sigma_pixel_px");
}

void team_start(SettingReader& r, Scenario& s, const Bodies& b) {
  using T = TeamStartSettings;
  r.section("start");
  r.some(s.team_start, &T::positions_m, &T::sigma_position_m);
  if (!b.line) r.some(s.team_start, &T::headings_rad, &T::sigma_heading_rad);
  if (!b.in_space) return;
  r.follower(s.team_start, &T::sigma_height_m, "start.sigma_position_m");
  r.some(s.slam.filter, &FilterSettings::sigma_start_velocity_m_s,
         &FilterSettings::sigma_start_angular_rate_rad_s);
}

void team_sensor(SettingReader& r, Scenario& s, const Bodies& b) {
  using S = SensorSettings;
  r.section("sensor");
  for (const SensorEntry& entry : registered_sensors())
    if (entry.traits.name == b.sensor.name)
      for (const ParameterInfo& p : entry.parameters)
        r.parameter(s.sensor.parameters.emplace(p.quantity.key(), p.default_value).first->second, p);
  if (b.camera)
    r.some(s.slam.filter, &FilterSettings::sigma_pixel_px);
  else
    ranges(r, s, b);
  if (!b.camera && !b.line) r.some(s.sensor, &S::field_of_view_rad);
  r.some(s.sensor, &S::ticks_per_measurement, &S::measures_vehicles);
}

void depth_lines(SettingReader& r, InitializationSettings& i) {
  using I = InitializationSettings;
  r.some(i, &I::min_depth_m, &I::max_depth_m, &I::particles, &I::depth_ratio, &I::max_line_failures);
}

/// Prior of landmarks whose distance is not measured, and their conversion to points.
void prior_depth(SettingReader& r, Scenario& s, const Bodies& b) {
  using I = InitializationSettings;
  I& i = s.slam.initialization;
  r.section("landmark_initialization");
  if (b.camera && !b.sensor.measures_distance) r.some(i, &I::method);
  if (i.method == I::Method::depth_line) {
    depth_lines(r, i);
  } else {
    if (!b.sensor.measures_distance) r.some(i, &I::inverse_depth_per_m, &I::sigma_inverse_depth_per_m);
    if (b.sensor.initial_form == LandmarkParametrization::Kind::inverse_depth) r.some(i, &I::max_linearity);
  }
  r.section("map");
  if (b.camera) r.some(s.slam.map, &MapSettings::wanted_visible);
}

void points(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  // Bodies of this world are driven by commands, and not held in a hand
  s.slam.filter.sigma_acceleration_m_s2 = s.slam.filter.sigma_angular_acceleration_rad_s2 = 1;
  s.slam.filter.sigma_start_velocity_m_s = s.slam.filter.sigma_start_angular_rate_rad_s = 0.2;
  s.slam.filter.sigma_pixel_px = 1;
  std::vector<std::string> sensors = sensor_words();
  std::rotate(sensors.begin(), std::find(sensors.begin(), sensors.end(), "camera"), sensors.end());
  sensor_type(r, s, sensors);
  vehicle_model(r, s, motion_names());
  const Bodies b = bodies_of(s);
  run(r, s, true, s.has_observability_report());
  point_landmarks(r, s.points);
  r.section("plant");
  const bool is_on_wheels = b.motion.is_planar_pose() && b.turns;
  if (b.camera && (is_on_wheels || b.in_space)) r.some(s.plant, &TruePlantSettings::motion);
  const bool carried = s.has_carried_camera();
  vehicle(r, s);
  if (b.in_space) accelerations(r, s);
  team_sensor(r, s, b);
  if (b.camera) camera(r, s, find_camera);
  if (b.camera && (!b.in_space || carried)) mount(r, s);
  if (b.motion.space == Space::uneven_ground || s.plant.motion == TruePlantSettings::Motion::terrain)
    terrain(r, s);
  team_start(r, s, b);
  plant(r, s, b);
  using F = PlanarFilterSettings;
  r.section("estimator");
  r.some(s.planar.filter, &F::linearization, &F::map_frame, &F::decorrelate);
  r.all(s.belief);
  prior_depth(r, s, b);
  s.planar.association = {.method = Method::known,
                          .gate_probability = 0.9999,
                          .initialization_probability = 0.99999999,
                          .initialization_distance_m = 0};
  association(r, s);
  pruning(r, s);
  point_health(r, s.planar.health);
  controller(r, s, b);
}

}  // namespace

void read_camera(SettingReader& r, CameraSettings& camera) {
  using C = CameraSettings;
  r.section("camera");
  r.alternative(camera, &C::model);
  r.some(camera, &C::width_px, &C::height_px, &C::fu_px, &C::fv_px, &C::u0_px, &C::v0_px);
}

void read_settings(SettingReader& r, Scenario& s, const CameraFinder& find_camera) {
  r.section("run");
  r.some(s.run, &RunSettings::seed, &RunSettings::duration_s);
  r.section("world");
  r.all(s.world);
  switch (s.world.type) {
    case WorldSettings::Type::room:
      return room(r, s, find_camera);
    case WorldSettings::Type::points:
      return points(r, s, find_camera);
    case WorldSettings::Type::recording:
      return recording(r, s, find_camera);
    case WorldSettings::Type::live:
      return live_camera(r, s, find_camera);
    case WorldSettings::Type::robot:
      return robot(r, s, find_camera);
  }
}

}  // namespace incognita
