#include "incognita/slam/features/validation.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace incognita {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void need(bool ok, const char* key, double value, const char* limit) {
  if (ok) return;
  std::ostringstream text;
  text << key << " = " << value << ": must be " << limit;
  throw std::invalid_argument(text.str());
}

void need_positive(const char* key, double value) {
  need(value > 0 && value < infinity, key, value, "more than 0, and finite");
}

void need_not_negative(const char* key, double value) {
  need(value >= 0 && value < infinity, key, value, "0 or more, and finite");
}

void need_at_least(const char* key, int value, int least, const char* limit) {
  need(value >= least, key, value, limit);
}

void validate(const FilterSettings& s) {
  need_not_negative("vehicle.sigma_acceleration_m_s2", s.sigma_acceleration_m_s2);
  need_not_negative("vehicle.sigma_angular_acceleration_rad_s2", s.sigma_angular_acceleration_rad_s2);
  need_positive("sensor.sigma_pixel_px", s.sigma_pixel_px);
  need_not_negative("sensor.sigma_lasting_px", s.sigma_lasting_px);
  need_positive("sensor.lasting_time_s", s.lasting_time_s);
  need_not_negative("start.sigma_velocity_m_s", s.sigma_start_velocity_m_s);
  need_not_negative("start.sigma_angular_rate_rad_s", s.sigma_start_angular_rate_rad_s);
}

void validate(const SearchSettings& s) {
  need(s.patch_size_px >= 9 && s.patch_size_px <= 15 && s.patch_size_px % 2 == 1, "search.patch_size_px",
       s.patch_size_px, "odd, 9 to 15");
  need_positive("search.gate_sigmas", s.gate_sigmas);
  need(s.min_correlation >= -1 && s.min_correlation <= 1, "search.min_correlation", s.min_correlation,
       "-1 to 1");
  need_at_least("search.max_measurements", s.max_measurements, 0, "0 or more");
  need_positive("search.budget_ms", s.budget_ms);
  need(s.levels >= 1 && s.levels <= 4, "search.levels", s.levels, "1 to 4");
  need_positive("search.max_half_axis_px", s.max_half_axis_px);
  need(s.gate_probability > 0 && s.gate_probability < 1, "search.gate_probability", s.gate_probability,
       "more than 0 and less than 1");
  need_positive("search.max_unconfirmed_sigma_px", s.max_unconfirmed_sigma_px);
}

void validate(const InitializationSettings& s) {
  need_at_least("landmark_initialization.box_width_px", s.box_width_px, 16, "16 or more");
  need_at_least("landmark_initialization.box_height_px", s.box_height_px, 16, "16 or more");
  need_not_negative("landmark_initialization.min_corner_strength", s.min_corner_strength);
  need_not_negative("landmark_initialization.look_ahead_s", s.look_ahead_s);
  need_not_negative("landmark_initialization.sigma_slope", s.sigma_slope);
  need_at_least("landmark_initialization.max_new_per_frame", s.max_new_per_frame, 0, "0 or more");
  need_at_least("landmark_initialization.particles", s.particles, 2, "2 or more");
  need_positive("landmark_initialization.min_depth_m", s.min_depth_m);
  need(s.max_depth_m > s.min_depth_m && s.max_depth_m < infinity, "landmark_initialization.max_depth_m",
       s.max_depth_m, "more than landmark_initialization.min_depth_m, and finite");
  need_positive("landmark_initialization.depth_ratio", s.depth_ratio);
  need_at_least("landmark_initialization.max_line_failures", s.max_line_failures, 1, "1 or more");
  need_positive("landmark_initialization.inverse_depth_per_m", s.inverse_depth_per_m);
  need_positive("landmark_initialization.sigma_inverse_depth_per_m", s.sigma_inverse_depth_per_m);
  need_not_negative("landmark_initialization.max_linearity", s.max_linearity);
}

void validate(const MapSettings& s) {
  need_at_least("map.wanted_visible", s.wanted_visible, 0, "0 or more");
  need_at_least("map.max_landmarks", s.max_landmarks, 1, "1 or more");
  need_positive("map.max_view_angle_rad", s.max_view_angle_rad);
  need(s.max_scale > 1 && s.max_scale < infinity, "map.max_scale", s.max_scale, "more than 1, and finite");
  need_at_least("map.min_attempts", s.min_attempts, 1, "1 or more");
  need(s.min_matched_share >= 0 && s.min_matched_share <= 1, "map.min_matched_share", s.min_matched_share,
       "0 to 1");
  need_at_least("map.memory_attempts", s.memory_attempts, 0, "0 or more");
}

void validate(const BundleSettings& s) {
  need_at_least("bundle.window", s.window, 2, "2 or more");
  need_at_least("bundle.min_frames", s.min_frames, 1, "1 or more");
  need(s.min_motion_share >= 0 && s.min_motion_share <= 1, "bundle.min_motion_share", s.min_motion_share,
       "0 to 1");
  need(s.min_start_motion_share >= 0 && s.min_start_motion_share <= 1, "bundle.min_start_motion_share",
       s.min_start_motion_share, "0 to 1");
  need(s.min_matched_share >= 0 && s.min_matched_share <= 1, "bundle.min_matched_share", s.min_matched_share,
       "0 to 1");
  need_at_least("bundle.max_iterations", s.max_iterations, 1, "1 or more");
  need_positive("bundle.limit_sigmas", s.limit_sigmas);
}

void validate(const RelocalizationSettings& s) {
  need_at_least("relocalization.period_frames", s.period_frames, 1, "1 or more");
  need_at_least("relocalization.min_matches", s.min_matches, 5, "5 or more: four fit the pose of any three");
  need(s.min_matched_share >= 0 && s.min_matched_share <= 1, "relocalization.min_matched_share",
       s.min_matched_share, "0 to 1");
  need_at_least("relocalization.min_distinctive", s.min_distinctive, 0, "0 or more");
  need(s.min_spread_share >= 0 && s.min_spread_share <= 1, "relocalization.min_spread_share",
       s.min_spread_share, "0 to 1");
  need_at_least("relocalization.confirmations", s.confirmations, 1, "1 or more");
  need_positive("relocalization.sigma_velocity_m_s", s.sigma_velocity_m_s);
  need_positive("relocalization.sigma_rate_rad_s", s.sigma_rate_rad_s);
}

/// With 0 matches required a camera without images would never be lost.
void validate(const HealthSettings& s) {
  need_at_least("health.min_matches", s.min_matches, 1, "1 or more");
  need_at_least("health.max_ticks", s.max_ticks, 1, "1 or more");
  need(s.max_sigma_position_m > 0, "health.max_sigma_position_m", s.max_sigma_position_m, "more than 0");
}

}  // namespace

void validate(const CameraSlamSettings& s, const std::optional<Target>& target, double max_search_s) {
  validate(s.filter);
  validate(s.search);
  validate(s.initialization);
  validate(s.map);
  validate(s.bundle);
  validate(s.relocalization);
  validate(s.health);
  need(max_search_s > 0, "start.max_search_s", max_search_s, "more than 0");
  if (target && target->corners.size() < 4)
    throw std::invalid_argument("start.target: " + target->name + " has " +
                                std::to_string(target->corners.size()) + " corners, and needs 4 or more");
}

void validate(const WheelOdometry& odometry) {
  need_not_negative("vehicle.sigma_speed_m_s", odometry.sigma_speed_m_s);
  need_positive("vehicle.sigma_turn_rate_rad_s", odometry.sigma_turn_rate_rad_s);
  need_positive("estimator.sigma_slip_m_s", odometry.sigma_slip_m_s);
}

}  // namespace incognita
