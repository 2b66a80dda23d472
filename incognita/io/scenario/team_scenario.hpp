// The settings of a team of vehicles: simulated with point landmarks (thesis Appendix B) or recorded.
//
// All vehicles share one motion model, sensor and control law; start poses and paths are individual.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "incognita/control/settings.hpp"

namespace incognita {

/// Start poses, their uncertainty, and whether the vehicles measure each other.
struct TeamStartSettings {
  std::vector<Eigen::Vector3d> positions_m{{0, 0, 0}};  ///< one per vehicle; z only for a flying one
  std::vector<double> headings_rad{0};                  ///< one per vehicle, or one for all
  double sigma_position_m = 0.01;                       ///< per axis, of the filter
  double sigma_height_m = 0.01;                         ///< of a body in space, along z
  double sigma_heading_rad = 0.01;                      ///< of a body in space, about each of its three axes
  bool sees_team = true;
};

struct TeamFilterChoice {
  std::string linearization = "analytic";
  std::string form = "covariance";  ///< `covariance` or `information`
  double gate_probability = 1;
};

/// Point landmarks of a simulation.
struct PointsSettings {
  int count = 16;
  Eigen::Vector3d size_m{30, 30, 2.5};  ///< uniform in +-x/2, +-y/2 about the center, and 0 to z
  Eigen::Vector2d center_m{0, 0};
  std::string file;  ///< instead, a table: id,x,y,z
  int known = 0;     ///< number of landmarks known a priori; -1: all (localization only)
};

/// The true vehicle where it differs from the filter's model.
struct PlantChoice {
  std::string motion = "as-believed";    ///< or `terrain`: true ground is uneven, the model's is flat
  double speed_ratio = 1;                ///< or `terrain`: uneven ground, unknown to the filter
  double turn_ratio = 1;                 ///< the same for turn rate or steering
  double sigma_start_position_m = 0.01;  ///< of the true start about the nominal one
  double sigma_start_height_m = 0.01;
  double sigma_start_heading_rad = 0.01;
  double sigma_speed_m_s = 0.05;
  double sigma_turn_rate_rad_s = 0.02;
  double sigma_steering_rad = 0.01;
  double sigma_acceleration_m_s2 = 0.3;
  double sigma_angular_acceleration_rad_s2 = 0.3;
  double sigma_range_m = 0.1;
  double sigma_range_ratio = 0;
  double sigma_bearing_rad = 0.0174533;
  double sigma_pixel_px = 1;
  double field_of_view_rad = 6.2831853;  ///< of a scanner, centered straight ahead
  int ticks_per_measurement = 1;         ///< measurement interval in ticks
};

struct TerrainChoice {
  std::string kind = "waves";  ///< `plane`, `waves` (two, crossing each other) or `image`
  double slope_x = 0, slope_y = 0;
  double amplitude_m = 0.15;
  double length_m = 6;
  std::string file;       ///< `image`: top view, its center at x = y = 0, columns along +x
  double size_m = 6;      ///< `image`: from the first column to the last
  double height_m = 0.3;  ///< `image`: height of white; black is 0
};

struct MountChoice {
  double forward_m = 0, left_m = 0, up_m = 0.6;
  double pitch_rad = 0, yaw_rad = 0;
};

struct StereoChoice {
  double baseline_m = 0.11;
  double least_disparity_px = 0.5;
};

struct SteerChoice {
  std::string law = "none";     ///< `none`, `tracking`, `lqg`, `feedback-linearisation`, `active`
  std::vector<double> input{};  ///< `none`: one per input of the motion; empty: stand still
  std::vector<double> gain_per_s{0.5};
  double control_point_m = 0.2;
  double gain_along_per_s = 1, gain_across_per_m2 = 4, gain_heading_per_m = 2;
  std::vector<double> weight_state{1}, weight_input{1};
  double max_speed_m_s = 1, max_turn_rate_rad_s = 1, max_steering_rad = 0.6;
  double avoidance_distance_m = 0;  ///< rendered room: slow down and turn away from nearer obstacles; 0: off
};

struct PathChoice {
  std::string kind = "point";         ///< `point`, `circle`, `back-and-forth`, `way-points`, `file`
  Eigen::Vector3d center_m{0, 0, 0};  ///< the point, or the center of the circle
  double heading_rad = 0;             ///< at the point
  double radius_m = 7;
  double rate_rad_s = 0.0872665;
  double phase_rad = 0;
  double amplitude_rad = 0.261799;
  std::vector<Eigen::Vector3d> points_m{};
  double speed_m_s = 0.5;
  std::string file;
  std::vector<Eigen::Vector3d> offsets_m{};  ///< offset of each vehicle's path; empty: all follow the same
};

struct TeamScenario {
  TeamStartSettings start;
  TeamFilterChoice filter;
  PointsSettings points;
  PlantChoice plant;
  TerrainChoice terrain;
  MountChoice mount;
  StereoChoice stereo;
  SteerChoice steer;
  PathChoice path;
  std::map<std::string, double> sensor_parameters = {};  ///< of further sensors, by full key: "sonar.range_m"

  /// The parameter with that full key, as declared by the sensors. A new one is set to `default_value`.
  double& sensor_parameter(const std::string& key, double default_value) {
    if (key == "stereo.baseline_m") return stereo.baseline_m;
    if (key == "stereo.least_disparity_px") return stereo.least_disparity_px;
    return sensor_parameters.emplace(key, default_value).first->second;
  }
};

}  // namespace incognita
