#include "incognita/io/scenario/team_setting_list.hpp"

#include "incognita/io/scenario/allowed.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {
namespace {

using namespace allowed;
using List = std::vector<Setting>;

void team(List& list, TeamStartSettings& s) {
  list.insert(
      list.end(),
      {
          {"team.positions_m", &s.positions_m, "m",
           "where each vehicle starts, [x, y, z] each: so many vehicles there are", between(-1e6, 1e6)},
          {"team.headings_rad", &s.headings_rad, "rad", "about z, from +x; one each, or one for all",
           between(-6.3, 6.3)},
          {"team.sigma_position_m", &s.sigma_position_m, "m",
           "per axis, of the filter's start; a true start is drawn around the above", between(0, 1e6)},
          {"team.sigma_height_m", &s.sigma_height_m, "m", "of a body in space, along z", between(0, 1e6)},
          {"team.sigma_heading_rad", &s.sigma_heading_rad, "rad", "likewise; of a body in space, each turn",
           between(0, 3.2)},
          {"team.sees_team", &s.sees_team, "", "whether vehicles see the others", any()},
      });
}

void team_filter(List& list, TeamFilterChoice& s) {
  list.insert(list.end(), {
                              {"team_filter.lineariser", &s.linearization, "", "which Kalman filter",
                               one_of({"analytic", "iterated", "unscented-vehicle", "first-estimate"})},
                              {"team_filter.form", &s.form, "", "what the filter keeps",
                               one_of({"covariance", "information"})},
                              {"team_filter.gate_probability", &s.gate_probability, "",
                               "of a right sighting being used; 1: all are used", between(0.5, 1)},
                          });
}

void points(List& list, PointsSettings& s) {
  list.insert(
      list.end(),
      {
          {"points.count", &s.count, "", "landmarks, drawn evenly", between(0, 10000)},
          {"points.size_m", &s.size_m, "m", "of where they are: +-x/2, +-y/2, 0 to z", between(0, 1e6)},
          {"points.centre_m", &s.center_m, "m", "of that place", between(-1e6, 1e6)},
          {"points.file", &s.file, "",
           "a table of them instead, with columns id, x, y and z; found beside the "
           "scenario or under the data folder",
           any()},
          {"points.known", &s.known, "",
           "so many of them the filter knows as anchors; -1: all, a map to find its place in",
           between(-1, 100000)},
      });
}

void plant(List& list, PlantChoice& s) {
  list.insert(
      list.end(),
      {
          {"plant.motion", &s.motion, "",
           "how the true vehicle moves: terrain under one that believes its ground to be flat, or under "
           "the vehicle that carries a camera which believes to fly",
           one_of({"as-believed", "terrain"})},
          {"plant.speed_ratio", &s.speed_ratio, "", "true speed over the one told", between(0.1, 10)},
          {"plant.turn_ratio", &s.turn_ratio, "", "true turn rate or steering over the one told",
           between(0.1, 10)},
          {"plant.sigma_start_position_m", &s.sigma_start_position_m, "m",
           "of the true start about the one told, per axis", between(0, 1e6)},
          {"plant.sigma_start_height_m", &s.sigma_start_height_m, "m", "likewise along z", between(0, 1e6)},
          {"plant.sigma_start_heading_rad", &s.sigma_start_heading_rad, "rad",
           "likewise of the heading, or each turn", between(0, 3.2)},
          {"plant.sigma_speed_m_s", &s.sigma_speed_m_s, "m/s", "true disturbance, held for one tick",
           between(0, 1000)},
          {"plant.sigma_turn_rate_rad_s", &s.sigma_turn_rate_rad_s, "rad/s", "likewise", between(0, 1000)},
          {"plant.sigma_steering_rad", &s.sigma_steering_rad, "rad", "likewise", between(0, 3.2)},
          {"plant.sigma_acceleration_m_s2", &s.sigma_acceleration_m_s2, "m/s^2", "likewise, per axis",
           between(0, 1e4)},
          {"plant.sigma_angular_acceleration_rad_s2", &s.sigma_angular_acceleration_rad_s2, "rad/s^2",
           "likewise, per axis", between(0, 1e4)},
          {"plant.sigma_range_m", &s.sigma_range_m, "m", "true noise of a range", between(0, 1000)},
          {"plant.sigma_range_ratio", &s.sigma_range_ratio, "", "times the range, added to it",
           between(0, 1)},
          {"plant.sigma_bearing_rad", &s.sigma_bearing_rad, "rad", "true noise of a bearing",
           between(0, 3.2)},
          {"plant.sigma_pixel_px", &s.sigma_pixel_px, "px", "true noise of a pixel, per axis",
           between(0, 100)},
          {"plant.field_of_view_rad", &s.field_of_view_rad, "rad", "of a scanner, about straight ahead",
           above_up_to(0, 6.2831854)},
          {"plant.ticks_per_look", &s.ticks_per_measurement, "", "it looks at every so many-th tick",
           between(1, 100000)},
      });
}

void terrain(List& list, TerrainChoice& s) {
  list.insert(
      list.end(),
      {
          {"terrain.kind", &s.kind, "", "waves: two across each other; image: a height map",
           one_of({"plane", "waves", "image"})},
          {"terrain.slope_x", &s.slope_x, "", "plane: m up per m along x", between(-2, 2)},
          {"terrain.slope_y", &s.slope_y, "", "plane: m up per m along y", between(-2, 2)},
          {"terrain.amplitude_m", &s.amplitude_m, "m", "waves", between(0, 100)},
          {"terrain.length_m", &s.length_m, "m", "waves: from crest to crest", between(0.01, 1e5)},
          {"terrain.file", &s.file, "",
           "image: grey, 8 or 16 bits, seen from above with its middle at the origin and x to the "
           "right; found beside the scenario or under the data folder",
           any()},
          {"terrain.size_m", &s.size_m, "m", "image: along x, from its first pixels to its last",
           between(0.01, 1e5)},
          {"terrain.height_m", &s.height_m, "m", "image: of white; black is at 0", between(-100, 100)},
      });
}

void mount(List& list, MountChoice& s) {
  list.insert(list.end(), {
                              {"mount.forward_m", &s.forward_m, "m", "camera before the vehicle's point",
                               between(-100, 100)},
                              {"mount.left_m", &s.left_m, "m", "left of it", between(-100, 100)},
                              {"mount.up_m", &s.up_m, "m", "above it", between(-100, 100)},
                              {"mount.pitch_rad", &s.pitch_rad, "rad", "upwards", between(-1.6, 1.6)},
                              {"mount.yaw_rad", &s.yaw_rad, "rad", "to the left", between(-3.2, 3.2)},
                          });
}

/// A section for each sensor with parameters, as the sensors declare them.
void sensors(List& list, TeamScenario& s) {
  for (const SensorEntry& sensor : registered_sensors())
    for (const ParameterInfo& p : sensor.parameters) {
      const std::string key = std::string(sensor.traits.word) + "." + p.quantity.key();
      list.push_back({key, &s.sensor_parameter(key, p.default_value), std::string(p.quantity.unit),
                      std::string(p.help), within(p.range)});
    }
}

void steer(List& list, SteerChoice& s) {
  list.insert(
      list.end(),
      {
          {"steer.law", &s.law, "", "none: the input is held; active: where most is learnt, thesis Chapter 6",
           one_of({"none", "tracking", "lqg", "feedback-linearisation", "active"})},
          {"steer.input", &s.input, "",
           "speed (m/s); with turn rate (rad/s) or steering (rad); of a body, accelerations along x y "
           "z "
           "(m/s^2) and about them (rad/s^2); none: it stands still",
           between(-1e4, 1e4)},
          {"steer.gain_per_s", &s.gain_per_s, "1/s", "on the position error, one or per axis: Q_2 of (5.9)",
           any()},
          {"steer.control_point_m", &s.control_point_m, "m", "on uneven ground: before the axle; not 0",
           between(-1000, 1000)},
          {"steer.gain_along_per_s", &s.gain_along_per_s, "1/s", "tracking: on the error ahead", any()},
          {"steer.gain_across_per_m2", &s.gain_across_per_m2, "1/m^2", "tracking: on the error aside", any()},
          {"steer.gain_heading_per_m", &s.gain_heading_per_m, "1/m", "tracking: on the heading's error",
           any()},
          {"steer.weight_state", &s.weight_state, "",
           "lqg: diagonal of Q_1 in (5.1); one number: all the same", any()},
          {"steer.weight_input", &s.weight_input, "", "lqg: diagonal of Q_2 in (5.1)", any()},
          {"steer.max_speed_m_s", &s.max_speed_m_s, "m/s", "what the vehicle can do", above_up_to(0, 1000)},
          {"steer.max_turn_rate_rad_s", &s.max_turn_rate_rad_s, "rad/s", "what the vehicle can do",
           above_up_to(0, 1000)},
          {"steer.max_steering_rad", &s.max_steering_rad, "rad", "what the vehicle can do",
           above_up_to(0, 1.5)},
          {"steer.keep_clear_m", &s.avoidance_distance_m, "m",
           "in the room: slower and away from walls and boxes that are nearer to its axle; 0: never",
           between(0, 10)},
      });
}

void path(List& list, PathChoice& s) {
  list.insert(
      list.end(),
      {
          {"path.kind", &s.kind, "", "where to be, in time",
           one_of({"point", "circle", "back-and-forth", "way-points", "file"})},
          {"path.centre_m", &s.center_m, "m", "the point, or the circle's centre", between(-1e6, 1e6)},
          {"path.heading_rad", &s.heading_rad, "rad", "point: where to look", between(-6.3, 6.3)},
          {"path.radius_m", &s.radius_m, "m", "of the circle", above_up_to(0, 1e6)},
          {"path.rate_rad_s", &s.rate_rad_s, "rad/s", "round the circle, to the left; not 0",
           between(-10, 10)},
          {"path.phase_rad", &s.phase_rad, "rad", "where on the circle it starts", between(-6.3, 6.3)},
          {"path.amplitude_rad", &s.amplitude_rad, "rad", "back-and-forth, thesis (5.28)",
           between(-3.2, 3.2)},
          {"path.points_m", &s.points_m, "m", "way-points, [x, y, z] each: at rest at each",
           between(-1e6, 1e6)},
          {"path.speed_m_s", &s.speed_m_s, "m/s", "way-points: the highest, midway", above_up_to(0, 1000)},
          {"path.file", &s.file, "",
           "a table with columns t, x, y, and if wanted z and heading; found beside the scenario or under "
           "the "
           "data folder",
           any()},
          {"path.offsets_m", &s.offsets_m, "m", "each vehicle's path is moved by, [x, y, z] each",
           between(-1e6, 1e6)},
      });
}

}  // namespace

std::vector<std::pair<const char*, const char*>> true_noise_defaults() {
  return {{"team.sigma_height_m", "team.sigma_position_m"},
          {"plant.sigma_start_position_m", "team.sigma_position_m"},
          {"plant.sigma_start_height_m", "team.sigma_height_m"},
          {"plant.sigma_start_heading_rad", "team.sigma_heading_rad"},
          {"plant.sigma_speed_m_s", "vehicle.sigma_speed_m_s"},
          {"plant.sigma_turn_rate_rad_s", "vehicle.sigma_turn_rate_rad_s"},
          {"plant.sigma_steering_rad", "vehicle.sigma_steering_rad"},
          {"plant.sigma_acceleration_m_s2", "filter.sigma_acceleration_m_s2"},
          {"plant.sigma_angular_acceleration_rad_s2", "filter.sigma_angular_acceleration_rad_s2"},
          {"plant.sigma_range_m", "ranges.sigma_range_m"},
          {"plant.sigma_range_ratio", "ranges.sigma_range_ratio"},
          {"plant.sigma_bearing_rad", "ranges.sigma_bearing_rad"},
          {"plant.sigma_pixel_px", "filter.sigma_pixel_px"}};
}

void list_team_settings(List& list, TeamScenario& t) {
  team(list, t.start);
  team_filter(list, t.filter);
  points(list, t.points);
  plant(list, t.plant);
  terrain(list, t.terrain);
  mount(list, t.mount);
  sensors(list, t);
  steer(list, t.steer);
  path(list, t.path);
}

}  // namespace incognita
