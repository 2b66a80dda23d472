// Settings of the camera estimator. Every field is one key of a scenario file; units are in the names.
#pragma once

#include <string>

namespace incognita {

struct FilterSettings {
  double sigma_acceleration_m_s2 = 1.0;            ///< unknown acceleration per axis, held for one frame
  double sigma_angular_acceleration_rad_s2 = 1.0;  ///< the same for angular acceleration
  double sigma_pixel_px = 1.0;                     ///< of one measured patch position, per axis
  double sigma_start_velocity_m_s = 0.2;           ///< per axis, at the start of the run
  double sigma_start_angular_rate_rad_s = 0.2;     ///< per axis, at the start of the run
  bool odometry = false;                           ///< the wheel odometry of the camera's carrier is used
  double sigma_slip_m_s = 0.02;  ///< per axis, deviation of the carrier from the no-slip constraint
};

struct SearchSettings {
  int patch_size_px = 11;               ///< side of the matched square, odd, 9 to 15
  double gate_sigmas = 3.0;             ///< half axes of the search ellipse in sigmas of the innovation
  double min_correlation = 0.8;         ///< normalized cross-correlation required for a match
  int max_measurements = 12;            ///< features searched for per frame, the most uncertain first
  double max_half_axis_px = 60;         ///< limit of the search in u and in v, from the center of the ellipse
  double gate_probability = 0.99;       ///< of a correct match, in each consistency test
  double max_unconfirmed_sigma_px = 8;  ///< re-detections predicted less precisely are unconfirmed
};

struct InitializationSettings {
  enum class Method { inverse_depth, depth_line };
  /// Center of a patch: the intersection of its edges, or the maximum of the corner strength.
  enum class Center { edges, peak };

  Method method = Method::inverse_depth;
  int box_width_px = 80;  ///< of the box in which a new feature is searched
  int box_height_px = 60;
  double min_corner_strength = 30;  ///< smaller eigenvalue of the structure tensor, gray levels^2 per pixel^2
  Center center = Center::edges;
  double look_ahead_s = 0.5;  ///< corners that leave the view within this time are rejected
  double sigma_slope = 0.7;   ///< prior tangent of a patch's tilt, per axis; 0: faces the camera
  int max_new_per_frame = 1;
  int particles = 100;       ///< `depth-line`: depth hypotheses on the ray
  double min_depth_m = 0.5;  ///< minimum depth along the ray, of lines and for look_ahead_s
  double max_depth_m = 5.0;
  double depth_ratio = 0.3;          ///< `depth-line`: sigma/depth below which a line becomes a point
  int max_line_failures = 10;        ///< `depth-line`: consecutive failed searches until a line is dropped
  double inverse_depth_per_m = 0.5;  ///< `inverse-depth`: prior mean
  double sigma_inverse_depth_per_m = 0.5;
  double max_linearity = 0.1;  ///< `inverse-depth`: Civera's linearity index below which it becomes a point
};

struct MapSettings {
  int wanted_visible = 12;          ///< new features are added while fewer are predicted in view
  int max_landmarks = 200;          ///< limit of mapped landmarks
  double max_view_angle_rad = 0.7;  ///< to the initial viewing direction; beyond, no match is expected
  double max_scale = 1.8;           ///< limit of the ratio to the initial distance, either way
  int min_attempts = 10;            ///< before a landmark can be deleted
  double min_matched_share = 0.5;   ///< of its attempts; with less a landmark is deleted
};

struct LostSettings {
  int min_matches = 3;                ///< a frame with fewer counts towards lost
  int max_frames = 10;                ///< consecutive frames with too few matches until lost
  double max_sigma_position_m = 0.5;  ///< upper limit of the position sigma
};

struct StartSettings {
  enum class From {
    target,  ///< pose solved from the known target
    free     ///< the first view is the origin
  };
  From from = From::target;
  std::string target;        ///< target file, beside the scenario or in the data folder
  double max_search_s = 10;  ///< lost when the target is not found by then
};

struct CameraSlamSettings {
  FilterSettings filter;
  SearchSettings search;
  InitializationSettings initialization;
  MapSettings map;
  LostSettings lost;
};

}  // namespace incognita
