#include "incognita/app/loop/body_models.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "incognita/app/loop/operator_assembly.hpp"
#include "incognita/io/formats/path_file.hpp"
#include "incognita/io/formats/point_file.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/io/scenario/scenario_file.hpp"
#include "incognita/io/scenario/terrain_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {
namespace {

using Law = ControlLaw;

SmallVector list(std::initializer_list<double> numbers) {
  SmallVector v(static_cast<Eigen::Index>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), v.begin());
  return v;
}

double heading_of_start(const TeamStartSettings& s, std::size_t i) {
  return s.headings_rad.size() == 1 ? s.headings_rad.front() : s.headings_rad.at(i);
}

/// True start state; for a carried camera that of its carrier.
SmallVector start_of(const Scenario& s, std::size_t i) {
  const Eigen::Vector3d& at = s.team_start.positions_m.at(i);
  const double heading = heading_of_start(s.team_start, i);
  if (s.has_carried_camera()) return TerrainVehicle::at_rest(at, heading);
  return at_rest(make_motion(s.planar.vehicle.model), at, heading);
}

/// Start of the estimated state; for a carried camera the camera state on its carrier at rest.
SmallVector estimated_start(const Scenario& s, std::size_t i, const Terrain& ground) {
  const SmallVector start = start_of(s, i);
  if (!s.has_carried_camera()) return start;
  return carried_camera({ground}, s.mount, start.head<3>(), TerrainVehicle::State<double>::Zero());
}

struct StartSigmas {
  double position_m, height_m, heading_rad, velocity_m_s, rate_rad_s;
};
SmallVector of_start(const Scenario& s, const StartSigmas& sigma) {
  return values_of(s.motion().error, {{"position_m", sigma.position_m},
                                      {"height_m", sigma.height_m},
                                      {"heading_rad", sigma.heading_rad},
                                      {"velocity_m_s", sigma.velocity_m_s},
                                      {"angular_rate_rad_s", sigma.rate_rad_s}});
}

struct InputSigmas {
  double speed_m_s, turn_rate_rad_s, steering_rad, acceleration_m_s2, angular_acceleration_rad_s2;
};
SmallVector of_inputs(const Scenario& s, const InputSigmas& sigma) {
  return values_of(s.motion().input, {{"speed_m_s", sigma.speed_m_s},
                                      {"turn_rate_rad_s", sigma.turn_rate_rad_s},
                                      {"steering_rad", sigma.steering_rad},
                                      {"acceleration_m_s2", sigma.acceleration_m_s2},
                                      {"angular_acceleration_rad_s2", sigma.angular_acceleration_rad_s2}});
}

SmallVector of_sensor(const AnySensor& sensor, double range_m, double bearing_rad, double pixel_px) {
  return values_of(traits_of(sensor).measurement,
                   {{"range_m", range_m}, {"bearing_rad", bearing_rad}, {"pixel_px", pixel_px}});
}

bool measures_ranges(const AnySensor& sensor) { return traits_of(sensor).measures("range"); }

SmallVector limits_of(const Scenario& s) {
  const ControllerSettings& can = s.controller;
  if (s.has_carried_camera()) return list({can.max_speed_m_s, can.max_turn_rate_rad_s});
  return of_inputs(s, {can.max_speed_m_s, can.max_turn_rate_rad_s, can.max_steering_rad,
                       s.control.max_acceleration_m_s2, s.control.max_angular_acceleration_rad_s2});
}

/// The true vehicle; for a carried camera its carrier with speed and turn rate as inputs.
PlantSettings plant_of(const Scenario& s, std::size_t i) {
  const TruePlantSettings& p = s.plant;
  PlantSettings plant;
  plant.start = start_of(s, i);
  plant.most_input = limits_of(s);
  plant.least_input = -plant.most_input;
  if (s.has_carried_camera()) {
    plant.start_sigmas =
        list({p.sigma_start_position_m, p.sigma_start_position_m, p.sigma_start_heading_rad});
    plant.input_sigmas = list({p.sigma_speed_m_s, p.sigma_turn_rate_rad_s});
    plant.input_ratios = list({p.speed_ratio, p.turn_ratio});
    return plant;
  }
  // The true vehicle starts at rest, even if the filter's start velocity is uncertain.
  plant.start_sigmas =
      of_start(s, {p.sigma_start_position_m, p.sigma_start_height_m, p.sigma_start_heading_rad, 0, 0});
  plant.input_sigmas = of_inputs(s, {p.sigma_speed_m_s, p.sigma_turn_rate_rad_s, p.sigma_steering_rad,
                                     p.sigma_acceleration_m_s2, p.sigma_angular_acceleration_rad_s2});
  plant.input_ratios = of_inputs(s, {p.speed_ratio, p.turn_ratio, p.turn_ratio, 1, 1});
  return plant;
}

Path path_of(PointPath path, const Eigen::Vector3d& offset, const LoadedScenario&) {
  path.position += offset;
  return path;
}
Path path_of(WayPointPath path, const Eigen::Vector3d& offset, const LoadedScenario&) {
  for (Eigen::Vector3d& point : path.points) point += offset;
  return path;
}
/// Circles.
Path path_of(auto path, const Eigen::Vector3d& offset, const LoadedScenario&) {
  path.center += offset;
  return path;
}
Path path_of(const PathFile& p, const Eigen::Vector3d& offset, const LoadedScenario& loaded) {
  const MotionTraits& motion = loaded.scenario.motion();
  PathSamples samples = read_path(find_named_file(loaded, "path.file", p.file));
  for (const Eigen::Vector3d& position : samples.position)
    if ((!motion.in_space() && position.z() != 0) || (motion.on_line() && position.y() != 0))
      throw InputError(
          fmt::format("{}: path.file = {}: has {} other than 0, where vehicle.model = `{}` can not go",
                      loaded.sources.at("path.file"), p.file, motion.on_line() ? "y or z" : "z",
                      loaded.scenario.planar.vehicle.model));
  for (Eigen::Vector3d& position : samples.position) position += offset;
  return attributed_to(loaded, "path.file", toml_string(p.file), [&] { return through(samples); });
}

/// Zero if no input is set.
SmallVector held_input(const Scenario& s, int inputs) {
  const std::vector<double>& input = s.controller.input;
  if (input.empty()) return SmallVector::Zero(inputs);
  return Eigen::Map<const Eigen::VectorXd>(input.data(), static_cast<Eigen::Index>(input.size()));
}

}  // namespace

Terrain ground_of(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const bool uneven =
      s.motion().space == Space::uneven_ground || s.plant.motion == TruePlantSettings::Motion::terrain;
  return uneven ? terrain_of(loaded) : Terrain{};
}

std::size_t vehicles_of(const Scenario& s) { return s.team_start.positions_m.size(); }

AnyMotion motion_of(const Scenario& s, const Terrain& ground) {
  AnyMotion motion = motion_of(s.planar.vehicle);
  set_terrain(motion, ground);
  return motion;
}

AnySensor sensor_of(const Scenario& s) {
  AnySensor sensor = make_sensor(s.sensor.type, s.motion());
  if (dimensions_of(sensor) == 3) set_camera(sensor, make_camera(s.camera), s.mount);
  set_model_parameters(sensor, [&](const std::string& key, double usual) {
    const auto given = s.sensor.parameters.find(key);
    return given == s.sensor.parameters.end() ? usual : given->second;
  });
  return sensor;
}

/// A camera is limited by its image. No limit for a full turn, to include a bearing of pi despite rounding.
static SensorLimits reach_of(const Scenario& s, const AnySensor& sensor) {
  SensorLimits sensor_limits;
  if (dimensions_of(sensor) == 3) return sensor_limits;
  sensor_limits.max_range_m = s.planar.sensor.max_range_m;
  const double field_rad = s.sensor.field_of_view_rad;
  if (field_rad < 6.2831853) sensor_limits.field_of_view_rad = field_rad;
  return sensor_limits;
}

BodyModel member_of(const Scenario& s, std::size_t i, const Terrain& ground) {
  const VehicleSettings& v = s.planar.vehicle;
  const FilterSettings& f = s.slam.filter;
  BodyModel m;
  m.motion = motion_of(s, ground);
  m.start = estimated_start(s, i, ground);
  const TeamStartSettings& start = s.team_start;
  m.start_sigmas = of_start(s, {start.sigma_position_m, start.sigma_height_m, start.sigma_heading_rad,
                                f.sigma_start_velocity_m_s, f.sigma_start_angular_rate_rad_s});
  m.input_sigmas = of_inputs(s, {v.sigma_speed_m_s, v.sigma_turn_rate_rad_s, v.sigma_steering_rad,
                                 f.sigma_acceleration_m_s2, f.sigma_angular_acceleration_rad_s2});
  PointSensor sensor{sensor_of(s), {}};
  sensor.sigmas = of_sensor(sensor.sensor, s.planar.sensor.sigma_range_m, s.planar.sensor.sigma_bearing_rad,
                            f.sigma_pixel_px);
  if (measures_ranges(sensor.sensor)) sensor.sigma_range_ratio = s.planar.sensor.sigma_range_ratio;
  sensor.limits = reach_of(s, sensor.sensor);
  m.sensors.push_back(std::move(sensor));
  return m;
}

MapperSettings filter_of(const Scenario& s) {
  MapperSettings f;
  f.linearization = s.planar.filter.linearization;
  f.map_frame = s.planar.filter.map_frame;
  f.decorrelate = s.planar.filter.decorrelate;
  f.form = s.belief.form;
  f.entropy = s.run.entropy;
  const DataAssociationSettings& association = s.planar.association;
  if (association.method == DataAssociationSettings::Method::known)
    f.gate_probability = association.gate_probability;
  f.inverse_depth_per_m = s.slam.initialization.inverse_depth_per_m;
  f.sigma_inverse_depth_per_m = s.slam.initialization.sigma_inverse_depth_per_m;
  f.max_linearity_index = s.slam.initialization.max_linearity;
  return f;
}

std::optional<DepthLineSettings> depth_lines_of(const Scenario& s) {
  const InitializationSettings& i = s.slam.initialization;
  if (i.method != InitializationSettings::Method::depth_line) return std::nullopt;
  return DepthLineSettings{i.depth_range(), i.depth_ratio, i.max_line_failures};
}

SimulatedVehicle simulated_vehicle(const Scenario& s, std::size_t i, const Terrain& ground) {
  const TruePlantSettings& p = s.plant;
  SimulatedBody body{motion_of(s, ground), plant_of(s, i), {}};
  if (p.motion == TruePlantSettings::Motion::terrain || s.has_carried_camera())
    body.motion = TerrainVehicle{ground};
  if (s.has_carried_camera()) body.mount = s.mount;
  if (s.operator_settings.holds) body.actuator = operator_of(s, i);
  SimulatedPointSensor sensor{sensor_of(s), {}};
  sensor.sigmas = of_sensor(sensor.model, p.sigma_range_m, p.sigma_bearing_rad, p.sigma_pixel_px);
  if (measures_ranges(sensor.model)) sensor.sigma_range_ratio = p.sigma_range_ratio;
  sensor.limits = reach_of(s, sensor.model);
  sensor.ticks_per_measurement = s.sensor.ticks_per_measurement;
  return {std::move(body), std::move(sensor)};
}

Eigen::Vector2d steered_point(const Scenario& s) {
  const Law law = s.controller.law;
  const VehicleSettings& v = s.planar.vehicle;
  const MotionTraits& motion = s.motion();
  if (motion.on_plane() && law != Law::none && steers_axle(law))
    return {-v.parameter("sensor_forward_m"), -v.parameter("sensor_left_m")};
  if (motion.space == Space::uneven_ground && !steers_axle(law)) return {s.law_settings.control_point_m, 0};
  return {0, 0};
}

BodyControl body_control_of(const LoadedScenario& loaded, std::size_t i, const Terrain& ground) {
  const Scenario& s = loaded.scenario;
  const ControllerSettings& c = s.controller;
  SteeringSettings out;
  if (s.has_carried_camera()) {
    out.input = held_input(s, TerrainVehicle::input_size);
    out.most_input = limits_of(s);
    return {TerrainVehicle{ground}, out, s.mount};
  }
  static_cast<LawSettings&>(out) = s.law_settings;
  out.law = c.law;
  AnyMotion motion = motion_of(s, ground);
  out.input = held_input(s, inputs_of(motion));
  out.camera = s.control;
  out.most_input = limits_of(s);
  const std::vector<Eigen::Vector3d>& offsets = s.path.offsets_m;
  const Eigen::Vector3d offset = offsets.empty() ? Eigen::Vector3d(0, 0, 0) : offsets.at(i);
  if (c.law == Law::active)
    out.path = PointPath{s.team_start.positions_m.at(i), heading_of_start(s.team_start, i)};
  else if (c.law != Law::none)
    out.path = std::visit([&](const auto& path) { return path_of(path, offset, loaded); }, s.path.type);
  BodyControl control{std::move(motion), out};
  control.operator_controlled = s.operator_settings.holds;
  return control;
}

ActiveSettings active_settings_of(const Scenario& s) {
  ActiveSettings out{s.decision, s.exploration};
  const ControllerSettings& can = s.controller;
  if (s.has_carried_camera() || s.is_camera_vehicle())
    out.carrier =
        CarrierSettings{s.mount, can.max_speed_m_s, can.max_turn_rate_rad_s, can.avoidance_distance_m};
  out.tick_s = 1 / s.run.rate_hz;
  if (s.operator_settings.holds) out.delay_s = s.operator_settings.delay_s;
  out.seed = static_cast<std::uint64_t>(s.run.seed);
  return out;
}

std::vector<std::string> input_names(const MotionTraits& motion) {
  std::vector<std::string> names;
  for (const Quantity& input : motion.input) names.push_back(input.key());
  return names;
}

std::unique_ptr<SlamEstimator> point_estimator(const LoadedScenario& loaded,
                                               const EstimatorSettings& settings) {
  const Scenario& s = loaded.scenario;
  const BodyModel& first = settings.bodies.front();
  const std::string problem = incompatibility(first.motion, first.sensors.front().sensor);
  if (!problem.empty())
    throw InputError(
        fmt::format("{}: sensor.type = {}: {}", loaded.source_of("sensor.type"), s.sensor.type, problem));
  // The settings that do not fit are named in the message: they depend on each other
  if (const std::string why = validate(settings);
      why.starts_with("estimator.") || why.starts_with("association."))
    throw std::invalid_argument(why);
  return attributed_to(loaded, "estimator.linearization", word_of(s.planar.filter.linearization),
                       [&] { return std::make_unique<SlamEstimator>(settings); });
}

PointLandmarks point_landmarks_of(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const PointsSettings& p = s.points;
  const int dimensions = dimensions_of(sensor_of(s));
  std::map<std::int64_t, Eigen::Vector3d> points;
  if (!p.file.empty()) points = read_points(find_named_file(loaded, "points.file", p.file));
  RandomStream random(static_cast<std::uint64_t>(s.run.seed), "points");
  for (int i = 0; p.file.empty() && i < p.count; ++i) {
    const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.5, 0.5), z = random.uniform(0, 1);
    points[i] = {p.center_m.x() + x * p.size_m.x(), p.center_m.y() + y * p.size_m.y(), z * p.size_m.z()};
  }
  PointLandmarks place;
  for (const auto& [identity, point] : points) {
    if (!p.file.empty() && !point.tail(3 - dimensions).isZero())
      throw InputError(
          fmt::format("{}: points.file = {}: landmark {} is off the {} that sensor.type = `{}` measures in",
                      loaded.sources.at("points.file"), p.file, identity, dimensions == 1 ? "line" : "plane",
                      s.sensor.type));
    place[identity] = point.head(dimensions);
  }
  return place;
}

}  // namespace incognita
