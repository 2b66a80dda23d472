#include "incognita/io/scenario/renamed_settings.hpp"

#include <algorithm>

#include "incognita/io/scenario/setting.hpp"

namespace incognita {
namespace {

constexpr RenamedSetting renamed[] = {
    {"run.world", "world.type"},
    {"run.sensor", "sensor.type"},
    {"filter.sigma_acceleration_m_s2", "vehicle.sigma_acceleration_m_s2"},
    {"filter.sigma_angular_acceleration_rad_s2", "vehicle.sigma_angular_acceleration_rad_s2"},
    {"filter.sigma_pixel_px", "sensor.sigma_pixel_px"},
    {"filter.sigma_start_velocity_m_s", "start.sigma_velocity_m_s"},
    {"filter.sigma_start_angular_rate_rad_s", "start.sigma_angular_rate_rad_s"},
    {"filter.odometry", "estimator.use_odometry"},
    {"filter.sigma_slip_m_s", "estimator.sigma_slip_m_s"},
    {"search.max_alone_sigma_px", "search.max_unconfirmed_sigma_px"},
    {"birth.method", "landmark_initialization.method"},
    {"birth.box_width_px", "landmark_initialization.box_width_px"},
    {"birth.box_height_px", "landmark_initialization.box_height_px"},
    {"birth.min_corner_strength", "landmark_initialization.min_corner_strength"},
    {"birth.look_ahead_s", "landmark_initialization.look_ahead_s"},
    {"birth.max_new_per_frame", "landmark_initialization.max_new_per_frame"},
    {"birth.sigma_slope", "landmark_initialization.sigma_slope"},
    {"birth.particles", "landmark_initialization.particles"},
    {"birth.min_depth_m", "landmark_initialization.min_depth_m"},
    {"birth.max_depth_m", "landmark_initialization.max_depth_m"},
    {"birth.depth_ratio", "landmark_initialization.depth_ratio"},
    {"birth.max_line_failures", "landmark_initialization.max_line_failures"},
    {"birth.inverse_depth_per_m", "landmark_initialization.inverse_depth_per_m"},
    {"birth.sigma_inverse_depth_per_m", "landmark_initialization.sigma_inverse_depth_per_m"},
    {"birth.max_linearity", "landmark_initialization.max_linearity"},
    {"birth.centre", "landmark_initialization.center"},
    {"lost.min_matches", "health.min_matches"},
    {"lost.max_frames", "health.max_ticks"},
    {"lost.max_sigma_position_m", "health.max_sigma_position_m"},
    {"vehicle_lost.max_sigma_position_m", "health.max_sigma_position_m"},
    {"vehicle_lost.max_unmatched_scans", "health.max_ticks"},
    {"decision.moves_m", "decision.displacements_m"},
    {"explore.expected_landmarks", "exploration.expected_landmarks"},
    {"explore.variance_expected_m2", "exploration.variance_expected_m2"},
    {"explore.counted", "exploration.counted"},
    {"explore.cell_m", "exploration.cell_m"},
    {"explore.seen_s", "exploration.seen_s"},
    {"explore.min_m", "exploration.volume_min_m"},
    {"explore.max_m", "exploration.volume_max_m"},
    {"control.gain_position_per_s2", "controller.gain_position_per_s2"},
    {"control.gain_velocity_per_s", "controller.gain_velocity_per_s"},
    {"control.gain_orientation_per_s2", "controller.gain_orientation_per_s2"},
    {"control.gain_rate_per_s", "controller.gain_rate_per_s"},
    {"control.max_acceleration_m_s2", "controller.max_acceleration_m_s2"},
    {"control.max_angular_acceleration_rad_s2", "controller.max_angular_acceleration_rad_s2"},
    {"control.gaze_amplitude_rad", "controller.swing_amplitude_rad"},
    {"control.gaze_period_s", "controller.swing_period_s"},
    {"person.holds", "operator.holds"},
    {"person.delay_s", "operator.delay_s"},
    {"person.wrong", "operator.wrong_probability"},
    {"person.sigma_way_ratio", "operator.sigma_length_ratio"},
    {"room.sigma_image_grey", "room.sigma_image_gray"},
    {"room.sigma_start_position_m", "plant.sigma_start_position_m"},
    {"room.sigma_start_heading_rad", "plant.sigma_start_heading_rad"},
    {"room.sigma_acceleration_m_s2", "plant.sigma_acceleration_m_s2"},
    {"room.sigma_angular_acceleration_rad_s2", "plant.sigma_angular_acceleration_rad_s2"},
    {"vehicle_start.position_m", "start.position_m"},
    {"vehicle_start.heading_rad", "start.heading_rad"},
    {"vehicle_start.at_first_fix", "start.at_first_fix"},
    {"vehicle_start.sigma_position_m", "start.sigma_position_m"},
    {"vehicle_start.sigma_heading_rad", "start.sigma_heading_rad"},
    {"vehicle_filter.lineariser", "estimator.linearization"},
    {"team_filter.lineariser", "estimator.linearization"},
    {"vehicle_filter.map_frame", "estimator.map_frame"},
    {"vehicle_filter.decorrelate", "estimator.decorrelate"},
    {"vehicle_filter.anchors_m", "estimator.anchors_m"},
    {"vehicle_filter.use_fixes", "estimator.use_fixes"},
    {"vehicle_filter.sigma_fix_m", "estimator.sigma_fix_m"},
    {"team_filter.form", "estimator.form"},
    {"team_filter.gate_probability", "association.gate_probability"},
    {"ranges.sigma_range_m", "sensor.sigma_range_m"},
    {"ranges.sigma_range_ratio", "sensor.sigma_range_ratio"},
    {"ranges.sigma_bearing_rad", "sensor.sigma_bearing_rad"},
    {"ranges.max_range_m", "sensor.max_range_m"},
    {"stereo.baseline_m", "sensor.baseline_m"},
    {"stereo.least_disparity_px", "sensor.least_disparity_px"},
    {"association.birth_probability", "association.initialization_probability"},
    {"association.birth_distance_m", "association.initialization_distance_m"},
    {"team.positions_m", "start.positions_m"},
    {"team.headings_rad", "start.headings_rad"},
    {"team.sigma_position_m", "start.sigma_position_m"},
    {"team.sigma_height_m", "start.sigma_height_m"},
    {"team.sigma_heading_rad", "start.sigma_heading_rad"},
    {"team.sees_team", "sensor.measures_vehicles"},
    {"points.centre_m", "points.center_m"},
    {"plant.field_of_view_rad", "sensor.field_of_view_rad"},
    {"plant.ticks_per_look", "sensor.ticks_per_measurement"},
    {"terrain.kind", "terrain.type"},
    {"steer.law", "controller.law"},
    {"steer.input", "controller.input"},
    {"steer.gain_per_s", "controller.gain_per_s"},
    {"steer.control_point_m", "controller.control_point_m"},
    {"steer.gain_along_per_s", "controller.gain_along_per_s"},
    {"steer.gain_across_per_m2", "controller.gain_across_per_m2"},
    {"steer.gain_heading_per_m", "controller.gain_heading_per_m"},
    {"steer.weight_state", "controller.weight_state"},
    {"steer.weight_input", "controller.weight_input"},
    {"steer.max_speed_m_s", "controller.max_speed_m_s"},
    {"steer.max_turn_rate_rad_s", "controller.max_turn_rate_rad_s"},
    {"steer.max_steering_rad", "controller.max_steering_rad"},
    {"steer.keep_clear_m", "controller.avoidance_distance_m"},
    {"path.kind", "path.type"},
    {"path.centre_m", "path.center_m"},
    {"path.centre_m", "path.position_m"},
};

}  // namespace

std::span<const RenamedSetting> renamed_settings() { return renamed; }

std::vector<std::string> new_keys(const std::string& key) {
  std::vector<std::string> keys;
  for (const RenamedSetting& setting : renamed)
    if (setting.before == key) keys.emplace_back(setting.after);
  return keys;
}

std::vector<std::string> new_sections(const std::string& section) {
  std::vector<std::string> sections;
  for (const RenamedSetting& setting : renamed) {
    if (section_of(setting.before) != section) continue;
    const std::string now = section_of(setting.after);
    if (std::find(sections.begin(), sections.end(), now) == sections.end()) sections.push_back(now);
  }
  return sections;
}

}  // namespace incognita
