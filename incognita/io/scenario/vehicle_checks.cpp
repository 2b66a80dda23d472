// Checks of vehicles with point landmarks, and of a vehicle in the rendered room.
#include "incognita/io/scenario/scenario_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;
using Law = ControlLaw;

bool follows_path(const Scenario& s) { return s.controller.law != Law::none && !s.decides(); }

/// A list of one number applies to all.
void check_length(const char* key, std::size_t size, std::size_t wanted, const char* what, List& found) {
  if (size == 1 || size == wanted) return;
  const std::string counts = wanted == 1 ? "1 number" : fmt::format("1 number or {}", wanted);
  found.push_back({key, fmt::format("must have {}, {}, and has {}", counts, what, size)});
}

void check_starts(const Scenario& s, List& found) {
  const TeamStartSettings& start = s.team_start;
  const std::size_t vehicles = start.positions_m.size();
  constexpr std::size_t most = 1000;
  if (vehicles == 0 || vehicles > most)
    found.push_back(
        {"start.positions_m", fmt::format("must have 1 to {} starts, one for each vehicle", most)});
  check_length("start.headings_rad", start.headings_rad.size(), vehicles, "one for each vehicle", found);
  const std::size_t offsets = s.path.offsets_m.size();
  if (offsets != 0 && offsets != vehicles)
    found.push_back({"path.offsets_m", fmt::format("must have {}, one for each vehicle, or none, and has {}",
                                                   vehicles, offsets)});
}

/// Vehicles that measure each other must not coincide.
void check_apart(const Scenario& s, List& found) {
  const auto& starts = s.team_start.positions_m;
  if (starts.size() < 2 || !s.sensor.measures_vehicles) return;
  constexpr double least_m = 0.1;
  for (std::size_t i = 0; i < starts.size(); ++i)
    for (std::size_t j = i + 1; j < starts.size(); ++j)
      if ((starts[i] - starts[j]).norm() < least_m)
        return found.push_back(
            {"start.positions_m",
             fmt::format("must be {} m apart or more, unless sensor.measures_vehicles is false: vehicles {} "
                         "and {} start in one place",
                         least_m, i + 1, j + 1)});
  const auto& offsets = s.path.offsets_m;
  if (!follows_path(s)) return;
  for (std::size_t i = 0; i < starts.size(); ++i)
    for (std::size_t j = i + 1; j < starts.size(); ++j)
      if (offsets.empty() || (offsets.size() == starts.size() && (offsets[i] - offsets[j]).norm() < least_m))
        return found.push_back(
            {"path.offsets_m",
             fmt::format("must be {} m apart or more, unless sensor.measures_vehicles is false: vehicles {} "
                         "and {} would be in one place at all times",
                         least_m, i + 1, j + 1)});
}

/// Checks the lengths of the gains of (5.1), the weights of (5.9) and the constant input against the motion model.
void check_gains(const Scenario& s, List& found) {
  const MotionTraits& motion = s.motion();
  const std::size_t inputs = s.has_carried_camera() ? motion_traits<TerrainVehicle>.input.size()
                                                    : motion.input.size(),
                    axes = motion.on_line() ? 1 : 2,
                    regulated = motion.in_space() ? motion.error.size() : axes;
  const ControllerSettings& c = s.controller;
  if (!c.input.empty() && c.input.size() != inputs)
    found.push_back({"controller.input",
                     fmt::format("must have {} number{}, one for each input of the motion, and has {}",
                                 inputs, inputs == 1 ? "" : "s", c.input.size())});
  check_length("controller.gain_per_s", s.law_settings.gain_per_s.size(), axes, "one for each axis", found);
  check_length("controller.weight_state", s.law_settings.weight_state.size(), regulated,
               "one for each number that is regulated", found);
  check_length("controller.weight_input", s.law_settings.weight_input.size(), inputs,
               "one for each input of the motion", found);
}

void check_path(const Scenario& s, List& found) {
  if (!follows_path(s)) return;
  const auto& path = s.path.type;
  if (const auto* way = std::get_if<WayPointPath>(&path); way && way->points.empty())
    found.push_back({"path.points_m", "must have way-points, path.type being `way-points`"});
  if (const auto* table = std::get_if<PathFile>(&path); table && table->file.empty())
    found.push_back({"path.file", "must name a table, path.type being `file`"});
  if (const auto* circle = std::get_if<CirclePath>(&path); circle && circle->rate_rad_s == 0)
    found.push_back({"path.rate_rad_s", "must not be 0: the path goes around the circle"});
}

/// Vehicles on the ground have no height, those on a line no lateral position.
void check_dimensions(const Scenario& s, List& found) {
  const std::string& model = s.planar.vehicle.model;
  const MotionTraits& motion = motion_traits_of(model);
  if (motion.in_space() && !s.has_carried_camera()) return;
  const bool line = motion.on_line();
  const auto check_places = [&](const char* key, const std::vector<Eigen::Vector3d>& places) {
    for (const Eigen::Vector3d& position : places)
      if (position.z() != 0 || (line && position.y() != 0))
        return found.push_back(
            {key, s.has_carried_camera()
                      ? "must have a z of 0: the vehicle that carries the camera is on the ground"
                      : fmt::format("must have {} with vehicle.model = `{}`",
                                    line ? "y and z of 0" : "a z of 0", model)});
  };
  check_places("start.positions_m", s.team_start.positions_m);
  if (!follows_path(s)) return;
  check_places("path.offsets_m", s.path.offsets_m);
  if (const auto* point = std::get_if<PointPath>(&s.path.type))
    check_places("path.position_m", {point->position});
  if (const auto* circle = std::get_if<CirclePath>(&s.path.type))
    check_places("path.center_m", {circle->center});
  if (const auto* circle = std::get_if<BackAndForthPath>(&s.path.type))
    check_places("path.center_m", {circle->center});
  if (const auto* way = std::get_if<WayPointPath>(&s.path.type)) check_places("path.points_m", way->points);
  if (line && (std::holds_alternative<CirclePath>(s.path.type) ||
               std::holds_alternative<BackAndForthPath>(s.path.type)))
    found.push_back(
        {"path.type", "must be `point`, `way-points` or `file` with vehicle.model = `" + model + "`"});
}

/// A law that controls a position needs a control point off the axle, thesis (5.13): its inverse contains 1 / l.
void check_control_point(const Scenario& s, List& found) {
  constexpr double least_m = 0.01;
  const Law law = s.controller.law;
  const MotionTraits& motion = s.motion();
  if (steers_axle(law)) return;
  const auto refuse = [&](const char* key) {
    found.push_back(
        {key, fmt::format(
                  "must be at least {} m off the axle for controller.law = `{}`: a point on the axle cannot "
                  "be moved sideways",
                  least_m, word_of(law))});
  };
  if (motion.on_plane() && std::abs(s.planar.vehicle.parameter("sensor_forward_m")) < least_m)
    refuse("vehicle.sensor_forward_m");
  if (motion.space == Space::uneven_ground && std::abs(s.law_settings.control_point_m) < least_m)
    refuse("controller.control_point_m");
}

void check_known(const Scenario& s, List& found) {
  const PointsSettings& p = s.points;
  if (p.file.empty() && p.known > p.count)
    found.push_back(
        {"points.known", fmt::format("must be at most points.count, which is {}, or -1 for all", p.count)});
  if (s.team_start.sigma_position_m > s.planar.health.max_sigma_position_m)
    found.push_back(
        {"start.sigma_position_m",
         fmt::format(
             "must be at most health.max_sigma_position_m, which is {}: the state would be `lost` from the "
             "start",
             s.planar.health.max_sigma_position_m)});
}

/// A zero-variance state has infinite information and cannot be represented in information form.
void check_form(const Scenario& s, List& found) {
  if (s.belief.form != BeliefForm::information) return;
  const auto check = [&](const char* key, double sigma) {
    if (!(sigma > 0))
      found.push_back({key,
                       "must be more than 0 with estimator.form = `information`: what is known exactly "
                       "has infinite information"});
  };
  check("start.sigma_position_m", s.team_start.sigma_position_m);
  const MotionTraits& motion = s.motion();
  if (!motion.on_line()) check("start.sigma_heading_rad", s.team_start.sigma_heading_rad);
  if (!motion.in_space()) return;
  check("start.sigma_height_m", s.team_start.sigma_height_m);
  check("start.sigma_velocity_m_s", s.slam.filter.sigma_start_velocity_m_s);
  check("start.sigma_angular_rate_rad_s", s.slam.filter.sigma_start_angular_rate_rad_s);
}

/// On uneven ground the middle of the axle follows the ground.
void check_plant(const Scenario& s, List& found) {
  const VehicleSettings& v = s.planar.vehicle;
  if (s.plant.motion == TruePlantSettings::Motion::terrain &&
      (v.parameter("sensor_forward_m") != 0 || v.parameter("sensor_left_m") != 0) && !s.motion().in_space())
    found.push_back(
        {"plant.motion",
         "must be `as-modeled` unless vehicle.sensor_forward_m and vehicle.sensor_left_m are 0: on "
         "uneven ground the middle of the axle follows the ground"});
}

/// Terrain and its image.
void check_terrain(const Scenario& s, List& found) {
  const bool uneven =
      s.motion().space == Space::uneven_ground || s.plant.motion == TruePlantSettings::Motion::terrain;
  const auto* image = std::get_if<ImageTerrain>(&s.terrain.type);
  if (uneven && image && image->file.empty())
    found.push_back({"terrain.file", "must name a gray image, terrain.type being `image`"});
}

void check_ticks(const Scenario& s, List& found) {
  constexpr double most_ticks = 1e9;
  if (s.run.duration_s * s.run.rate_hz > most_ticks)
    found.push_back({"run.duration_s", fmt::format("must make at most {:g} ticks, run.rate_hz being {}",
                                                   most_ticks, s.run.rate_hz)});
}

/// One vehicle, inside the room, with a control law for wheeled vehicles.
void check_in_room(const Scenario& s, List& found) {
  if (s.team_start.positions_m.size() != 1)
    return found.push_back({"start.positions_m", "must have one start: the room has one vehicle"});
  const Eigen::Vector3d &start = s.team_start.positions_m.front(), &size = s.room.size_m;
  const double margin = s.room.clearance_m;
  if (std::abs(start.x()) > size.x() / 2 - margin || std::abs(start.y()) > size.y() / 2 - margin)
    found.push_back({"start.positions_m",
                     fmt::format("must be inside room.size_m [{:g}, {:g}, {:g}], room.clearance_m {:g} from "
                                 "the walls",
                                 size.x(), size.y(), size.z(), margin)});
}

/// The avoidance distance must leave a braking distance in front of the body.
void check_obstacle_avoidance(const Scenario& s, List& found) {
  const double clear = s.controller.avoidance_distance_m;
  if (clear == 0) return;
  const double least = s.room.clearance_m + 0.1 + 2 * s.controller.max_speed_m_s / s.run.rate_hz;
  if (clear < least)
    found.push_back(
        {"controller.avoidance_distance_m",
         fmt::format("must be 0 or at least {:.3g}: room.clearance_m, 0.1 m, and the way of two ticks of "
                     "run.rate_hz at controller.max_speed_m_s",
                     least)});
}

}  // namespace

void check_room_vehicle(const Scenario& s, List& found) {
  check_in_room(s, found);
  check_length("start.headings_rad", s.team_start.headings_rad.size(), 1, "that of the vehicle", found);
  check_gains(s, found);
  check_path(s, found);
  check_dimensions(s, found);
  check_control_point(s, found);
  check_terrain(s, found);
  check_obstacle_avoidance(s, found);
  if (!(s.mount.up_m > 0))
    found.push_back({"mount.up_m", "must be more than 0: the camera sees nothing from under the ground"});
}

void check_robot(const Scenario& s, List& found) {
  check_gains(s, found);
  check_path(s, found);
  check_dimensions(s, found);
  check_control_point(s, found);
  const RobotSettings& r = s.robot;
  if (r.late_s <= 1 / s.run.rate_hz)
    found.push_back(
        {"robot.late_s",
         fmt::format("must be more than the time of a frame, {:.3g} s (run.rate_hz)", 1 / s.run.rate_hz)});
  if (r.give_up_s <= r.late_s) found.push_back({"robot.give_up_s", "must be more than robot.late_s"});
  if (r.address.empty()) found.push_back({"robot.address", "must be an address such as ws://localhost:9090"});
  if (r.image_topic.empty()) found.push_back({"robot.image_topic", "must name a topic"});
  if (r.command_topic.empty()) found.push_back({"robot.command_topic", "must name a topic"});
}

void check_team(const Scenario& s, List& found) {
  check_form(s, found);
  if (s.is_recording()) return;
  check_ticks(s, found);
  check_starts(s, found);
  check_apart(s, found);
  check_gains(s, found);
  check_path(s, found);
  check_dimensions(s, found);
  check_control_point(s, found);
  check_known(s, found);
  check_plant(s, found);
  check_terrain(s, found);
  if (s.measured().dimensions == 3) check_camera(s, found);
}

}  // namespace incognita
