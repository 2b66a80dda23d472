// What can be set on the camera estimator. Every field is one key of a scenario file; units are in the names.
#pragma once

#include <string>

namespace incognita {

struct FilterSettings {
  double sigma_acceleration_m_s2 = 1.0;  ///< unknown linear acceleration per axis, held for one frame
  double sigma_angular_acceleration_rad_s2 =
      1.0;                                      ///< unknown angular acceleration per axis, held for one frame
  double sigma_pixel_px = 1.0;                  ///< of one measured patch position, per axis
  double sigma_start_velocity_m_s = 0.2;        ///< per axis, when the run starts
  double sigma_start_angular_rate_rad_s = 0.2;  ///< per axis, when the run starts
  bool odometry = false;         ///< whether what the wheels of the camera's vehicle tell is used
  double sigma_slip_m_s = 0.02;  ///< per axis: how far the vehicle moves otherwise than its wheels say
};

struct SearchSettings {
  int patch_size_px = 11;        ///< side of the square compared, odd, 9 to 15
  double gate_sigmas = 3.0;      ///< half axes of the search ellipse in standard deviations of the innovation
  double min_correlation = 0.8;  ///< normalised cross-correlation below which nothing was found
  int max_measurements = 12;     ///< looks searched for in a frame, the most uncertain first
  double max_half_axis_px = 60;  ///< an ellipse is searched no further out than this
  double gate_probability = 0.99;  ///< of a right match passing each consistency test
  double max_unconfirmed_sigma_px =
      8;  ///< what returns and the others tell nothing nearer of is not believed
};

struct InitializationSettings {
  enum class Method { inverse_depth, depth_line };
  /// Of a patch: where its edges meet, or the peak of the corner measure.
  enum class Center { edges, peak };

  Method method = Method::inverse_depth;
  int box_width_px = 80;  ///< of the box a new feature is looked for in
  int box_height_px = 60;
  double min_corner_strength = 30;  ///< smaller eigenvalue of the structure tensor, grey levels^2 per pixel
  Center center = Center::edges;
  double look_ahead_s = 0.5;  ///< a corner about to leave the view within this time is not taken
  double sigma_slope =
      0.7;  ///< tangent of a patch's tilt, per axis, before it is learnt; 0: faces the camera
  int max_new_per_frame = 1;
  int particles = 100;  ///< `depth-line`: depths tried on the line of sight
  double min_depth_m =
      0.5;  ///< a new feature is this far at the least, along its ray: of lines, and to look ahead
  double max_depth_m = 5.0;
  double depth_ratio = 0.3;    ///< `depth-line`: sigma/depth below which a line becomes a point
  int max_line_failures = 10;  ///< `depth-line`: attempts after which a line without a point is given up
  double inverse_depth_per_m = 0.5;  ///< `inverse-depth`: mean before anything is known
  double sigma_inverse_depth_per_m = 0.5;
  double max_linearity = 0.1;  ///< `inverse-depth`: Civera's index below which it becomes a point
};

struct MapSettings {
  int wanted_visible = 12;  ///< new features are looked for while fewer are expected in view
  int max_landmarks = 200;  ///< a hard cap on what is mapped
  double max_view_angle_rad =
      0.7;                 ///< from the view a patch was taken at; beyond, it is not expected to match
  double max_scale = 1.8;  ///< how much nearer or farther than at birth a patch may be seen
  int min_attempts = 10;   ///< before a landmark can be judged
  double min_matched_share = 0.5;  ///< of its attempts, below which a landmark is deleted
};

struct LostSettings {
  int min_matches = 3;                ///< a frame with fewer counts towards being lost
  int max_frames = 10;                ///< so many such frames in a row: lost
  double max_sigma_position_m = 0.5;  ///< beyond, lost whatever matches
};

struct StartSettings {
  enum class From {
    target,  ///< pose solved from the known target
    free     ///< here is the origin
  };
  From from = From::target;
  std::string target;        ///< target file, found beside the scenario or under the data folder
  double max_search_s = 10;  ///< give up when the target was not found by then
};

struct CameraSlamSettings {
  FilterSettings filter;
  SearchSettings search;
  InitializationSettings initialization;
  MapSettings map;
  LostSettings lost;
};

}  // namespace incognita
