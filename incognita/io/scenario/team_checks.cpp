#include "incognita/io/scenario/team_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "incognita/io/scenario/team_setting_list.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

void check_recorded(const Scenario& s, List& found) {
  if (s.recording.folder.empty())
    found.push_back({"recording.folder", "must name the recording of the team"});
  if (s.recording.format != "mrclam" && s.recording.format != "auto")
    found.push_back({"recording.format", "must be `mrclam` or `auto`: a recording of a team"});
  if (s.run.sensor != "range-bearing")
    found.push_back({"run.sensor", "must be `range-bearing`: so the recorded teams see"});
  if (s.planar.vehicle.model != "differential-drive")
    found.push_back({"vehicle.model", "must be `differential-drive`: so the recorded teams move"});
}

/// A list of one number applies to all.
void check_length(const char* key, std::size_t size, std::size_t wanted, const char* what, List& found) {
  if (size == 1 || size == wanted) return;
  const std::string counts = wanted == 1 ? "1 number" : fmt::format("1 number or {}", wanted);
  found.push_back({key, fmt::format("must have {}, {}, and has {}", counts, what, size)});
}

void check_starts(const Scenario& s, List& found) {
  const TeamStartSettings& start = s.team.start;
  const std::size_t vehicles = start.positions_m.size();
  constexpr std::size_t most = 1000;
  if (vehicles == 0 || vehicles > most)
    found.push_back(
        {"team.positions_m", fmt::format("must have 1 to {} starts, one for each vehicle", most)});
  check_length("team.headings_rad", start.headings_rad.size(), vehicles, "one for each vehicle", found);
  const std::size_t offsets = s.team.path.offsets_m.size();
  if (offsets != 0 && offsets != vehicles)
    found.push_back({"path.offsets_m", fmt::format("must have {}, one for each vehicle, or none, and has {}",
                                                   vehicles, offsets)});
}

/// Vehicles that measure each other must not coincide.
void check_apart(const Scenario& s, List& found) {
  const auto& starts = s.team.start.positions_m;
  if (starts.size() < 2 || !s.team.start.sees_team) return;
  constexpr double least_m = 0.1;
  for (std::size_t i = 0; i < starts.size(); ++i)
    for (std::size_t j = i + 1; j < starts.size(); ++j)
      if ((starts[i] - starts[j]).norm() < least_m)
        return found.push_back(
            {"team.positions_m",
             fmt::format("must be {} m apart or more, unless team.sees_team is false: vehicles {} "
                         "and {} start in one place",
                         least_m, i + 1, j + 1)});
  const std::string& law = s.team.steer.law;
  const auto& offsets = s.team.path.offsets_m;
  if (law == "none" || law == "active") return;
  for (std::size_t i = 0; i < starts.size(); ++i)
    for (std::size_t j = i + 1; j < starts.size(); ++j)
      if (offsets.empty() || (offsets.size() == starts.size() && (offsets[i] - offsets[j]).norm() < least_m))
        return found.push_back(
            {"path.offsets_m",
             fmt::format("must be {} m apart or more, unless team.sees_team is false: vehicles {} "
                         "and {} would be in one place at all times",
                         least_m, i + 1, j + 1)});
}

void check_association(const Scenario& s, List& found) {
  const DataAssociationSettings& a = s.planar.association;
  if (a.method != "known" && a.initialization_probability < a.gate_probability)
    found.push_back({"association.birth_probability",
                     "must be association.gate_probability or more: what is inside its gate is no new one"});
}

/// Checks the lengths of the gains of (5.1), the weights of (5.9) and the constant input against the motion model.
void check_gains(const Scenario& s, List& found) {
  const MotionTraits& motion = motion_traits_of(s.planar.vehicle.model);
  const std::size_t inputs = has_carried_camera(s) ? motion_traits<TerrainVehicle>.input.size()
                                                   : motion.input.size(),
                    axes = motion.on_line() ? 1 : 2,
                    regulated = motion.in_space() ? motion.error.size() : axes;
  const SteerChoice& c = s.team.steer;
  if (!c.input.empty() && c.input.size() != inputs)
    found.push_back(
        {"steer.input", fmt::format("must have {} numbers, one for each input of the motion, and has {}",
                                    inputs, c.input.size())});
  check_length("steer.gain_per_s", c.gain_per_s.size(), axes, "one for each axis", found);
  check_length("steer.weight_state", c.weight_state.size(), regulated,
               "one for each number that is regulated", found);
  check_length("steer.weight_input", c.weight_input.size(), inputs, "one for each input of the motion",
               found);
}

void check_path(const Scenario& s, List& found) {
  if (s.team.steer.law == "none" || s.team.steer.law == "active") return;
  const PathChoice& p = s.team.path;
  if (p.kind == "way-points" && p.points_m.empty())
    found.push_back({"path.points_m", "must have way-points, path.kind being `way-points`"});
  if (p.kind == "file" && p.file.empty())
    found.push_back({"path.file", "must name a table, path.kind being `file`"});
  if (p.kind == "circle" && p.rate_rad_s == 0)
    found.push_back({"path.rate_rad_s", "must not be 0: on a circle one goes round"});
}

/// Vehicles on the ground have no height, those on a line no lateral position.
void check_dimensions(const Scenario& s, List& found) {
  const std::string& model = s.planar.vehicle.model;
  const MotionTraits& motion = motion_traits_of(model);
  if (motion.in_space() && !has_carried_camera(s)) return;
  const bool line = motion.on_line();
  const auto check_places = [&](const char* key, const std::vector<Eigen::Vector3d>& places) {
    for (const Eigen::Vector3d& position : places)
      if (position.z() != 0 || (line && position.y() != 0))
        return found.push_back(
            {key, has_carried_camera(s)
                      ? "must have a z of 0: the vehicle that carries the camera stands on the ground"
                      : fmt::format("must have {} with vehicle.model = `{}`",
                                    line ? "y and z of 0" : "a z of 0", model)});
  };
  check_places("team.positions_m", s.team.start.positions_m);
  const std::string& law = s.team.steer.law;
  if (law == "none" || law == "active") return;
  check_places("path.offsets_m", s.team.path.offsets_m);
  check_places("path.centre_m", {s.team.path.center_m});
  check_places("path.points_m", s.team.path.points_m);
  if (line && (s.team.path.kind == "circle" || s.team.path.kind == "back-and-forth"))
    found.push_back(
        {"path.kind", "must be `point`, `way-points` or `file` with vehicle.model = `" + model + "`"});
}

/// A law that controls a position needs a control point off the axle, thesis (5.13): its inverse contains 1 / l.
void check_control_point(const Scenario& s, List& found) {
  constexpr double least_m = 0.01;
  const std::string& law = s.team.steer.law;
  const MotionTraits& motion = motion_traits_of(s.planar.vehicle.model);
  if (law == "none" || law == "tracking") return;
  const auto refuse = [&](const char* key) {
    found.push_back(
        {key, fmt::format("must be at least {} m off the axle for steer.law = `{}`: on the axle the point "
                          "that is steered cannot be moved sideways",
                          least_m, law)});
  };
  if (motion.on_plane() && std::abs(s.planar.vehicle.sensor_forward_m) < least_m)
    refuse("vehicle.sensor_forward_m");
  if (motion.space == Space::uneven_ground && std::abs(s.team.steer.control_point_m) < least_m)
    refuse("steer.control_point_m");
}

void check_known(const Scenario& s, List& found) {
  const PointsSettings& p = s.team.points;
  if (p.file.empty() && p.known > p.count)
    found.push_back(
        {"points.known", fmt::format("must be at most points.count, which is {}, or -1 for all", p.count)});
  if (s.team.start.sigma_position_m > s.planar.lost.max_sigma_position_m)
    found.push_back(
        {"team.sigma_position_m",
         fmt::format("must be at most vehicle_lost.max_sigma_position_m, which is {}: it would be lost "
                     "before it starts",
                     s.planar.lost.max_sigma_position_m)});
}

/// A zero-variance state has infinite information and cannot be represented in information form.
void check_form(const Scenario& s, List& found) {
  if (s.team.filter.form != "information") return;
  const auto check = [&](const char* key, double sigma) {
    if (!(sigma > 0))
      found.push_back({key,
                       "must be more than 0 with team_filter.form = `information`: what is known exactly "
                       "has infinite information"});
  };
  check("team.sigma_position_m", s.team.start.sigma_position_m);
  const MotionTraits& motion = motion_traits_of(s.planar.vehicle.model);
  if (!motion.on_line()) check("team.sigma_heading_rad", s.team.start.sigma_heading_rad);
  if (!motion.in_space()) return;
  check("filter.sigma_start_velocity_m_s", s.slam.filter.sigma_start_velocity_m_s);
  check("filter.sigma_start_angular_rate_rad_s", s.slam.filter.sigma_start_angular_rate_rad_s);
}

/// Active law: the bounds must contain the starts.
void check_bounds(const Scenario& s, List& found) {
  if (s.team.steer.law != "active") return;
  const DecisionSettings& d = s.decision;
  if ((d.max_bound_m.array() <= d.min_bound_m.array()).any())
    return found.push_back(
        {"decision.max_bound_m", "must be more than decision.min_bound_m along each axis"});
  const int axes = has_carried_camera(s) ? 2 : 3;  // the height of a carried camera follows the ground
  for (const Eigen::Vector3d& at : s.team.start.positions_m)
    if ((at.head(axes).array() < d.min_bound_m.head(axes).array()).any() ||
        (at.head(axes).array() > d.max_bound_m.head(axes).array()).any())
      return found.push_back({"decision.min_bound_m", "must leave every start of team.positions_m inside"});
}

void check_plant(const Scenario& s, List& found) {
  const VehicleSettings& v = s.planar.vehicle;
  const std::string& law = s.team.steer.law;
  if (has_carried_camera(s) && law != "none" && law != "active")
    return found.push_back({"steer.law",
                            "must be `active`, or `none` with a steer.input of a speed and a turn "
                            "rate, with plant.motion = `terrain` under a camera that is carried"});
  const SensorTraits& sensor = sensor_traits_of(s.run.sensor, motion_traits_of(s.planar.vehicle.model));
  if (s.team.plant.motion == "terrain" && sensor.dimensions != 3)
    return found.push_back({"plant.motion", "must be `as-believed` with run.sensor = `" + s.run.sensor +
                                                "`: on uneven ground the plane of a scanner tilts"});
  if (s.team.plant.motion == "terrain" && (v.sensor_forward_m != 0 || v.sensor_left_m != 0))
    found.push_back({"plant.motion",
                     "must be `as-believed` unless vehicle.sensor_forward_m and "
                     "vehicle.sensor_left_m are 0: on uneven ground the middle of the axle is "
                     "followed"});
}

void check_terrain(const Scenario& s, List& found) {
  const MotionTraits& motion = motion_traits_of(s.planar.vehicle.model);
  const bool uneven = motion.space == Space::uneven_ground || s.team.plant.motion == "terrain";
  if (uneven && s.team.terrain.kind == "image" && s.team.terrain.file.empty())
    found.push_back({"terrain.file", "must name a grey image, terrain.kind being `image`"});
}

void check_ticks(const Scenario& s, List& found) {
  constexpr double most_ticks = 1e9;
  if (s.run.duration_s * s.run.rate_hz > most_ticks)
    found.push_back({"run.duration_s", fmt::format("must make at most {:g} ticks, run.rate_hz being {}",
                                                   most_ticks, s.run.rate_hz)});
}

/// One vehicle, inside the room, with a control law for wheeled vehicles.
void check_in_room(const Scenario& s, List& found) {
  if (s.team.start.positions_m.size() != 1)
    return found.push_back({"team.positions_m", "must have one start: the room has one vehicle"});
  const Eigen::Vector3d &start = s.team.start.positions_m.front(), &size = s.room.size_m;
  const double margin = s.room.clearance_m;
  if (std::abs(start.x()) > size.x() / 2 - margin || std::abs(start.y()) > size.y() / 2 - margin)
    found.push_back({"team.positions_m",
                     fmt::format("must be inside room.size_m [{:g}, {:g}, {:g}], room.clearance_m {:g} from "
                                 "the walls",
                                 size.x(), size.y(), size.z(), margin)});
  const std::string& law = s.team.steer.law;
  if (law == "lqg")
    found.push_back(
        {"steer.law", "must be `active`, `none`, `tracking` or `feedback-linearisation` in the room"});
}

/// The avoidance distance must leave a braking distance in front of the body.
void check_obstacle_avoidance(const Scenario& s, List& found) {
  const double clear = s.team.steer.avoidance_distance_m;
  if (clear == 0) return;
  const double least = s.room.clearance_m + 0.1 + 2 * s.team.steer.max_speed_m_s / s.run.rate_hz;
  if (clear < least)
    found.push_back(
        {"steer.keep_clear_m",
         fmt::format("must be 0 or at least {:.3g}: room.clearance_m, 0.1 m, and what steer.max_speed_m_s "
                     "drives in two ticks",
                     least)});
}

}  // namespace

void check_room_vehicle(const Scenario& s, List& found) {
  check_in_room(s, found);
  check_length("team.headings_rad", s.team.start.headings_rad.size(), 1, "that of the vehicle", found);
  check_gains(s, found);
  check_path(s, found);
  check_dimensions(s, found);
  check_control_point(s, found);
  check_terrain(s, found);
  check_obstacle_avoidance(s, found);
  if (!(s.team.mount.up_m > 0))
    found.push_back({"mount.up_m", "must be more than 0: the camera sees nothing from under the ground"});
}

void check_team(const Scenario& s, List& found) {
  check_form(s, found);
  if (s.run.world == "recording") return check_recorded(s, found);
  check_ticks(s, found);
  check_starts(s, found);
  check_apart(s, found);
  check_association(s, found);
  check_gains(s, found);
  check_path(s, found);
  check_dimensions(s, found);
  check_control_point(s, found);
  check_known(s, found);
  check_bounds(s, found);
  check_plant(s, found);
  check_terrain(s, found);
  if (sensor_traits_of(s.run.sensor, motion_traits_of(s.planar.vehicle.model)).dimensions == 3)
    check_camera(s, found);
}

}  // namespace incognita
