// Settings of the camera estimator.
#pragma once

#include <string>

#include "incognita/math/setting.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

struct FilterSettings {
  double sigma_acceleration_m_s2 = 4;  // of a hand
  double sigma_angular_acceleration_rad_s2 = 6;
  double sigma_pixel_px = 0.5;
  bool adapt_sigma_pixel = true;
  double sigma_lasting_px = 0;
  double lasting_time_s = 6.5;
  double sigma_start_velocity_m_s = 1;  // it may move when it starts
  double sigma_start_angular_rate_rad_s = 1;
  bool odometry = false;
  double sigma_slip_m_s = 0.02;
  bool invariant = false;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = FilterSettings;
    setting(&S::sigma_acceleration_m_s2, "sigma_acceleration_m_s2", "m/s^2", between(0, 1e4),
            "Standard deviation of the unknown acceleration per axis, constant over one frame");
    setting(&S::sigma_angular_acceleration_rad_s2, "sigma_angular_acceleration_rad_s2", "rad/s^2",
            between(0, 1e4),
            "Standard deviation of the unknown angular acceleration per axis, constant over one frame");
    setting(&S::sigma_pixel_px, "sigma_pixel_px", "px", between(0.001, 100),
            "Standard deviation of one measured image position, per axis");
    setting(
        &S::adapt_sigma_pixel, "adapt_sigma_pixel", "", any(),
        "Whether `sigma_pixel_px` is only the first value, and follows the residuals of the matches, 0.25 to 2 px; in the "
        "correction its square is multiplied by (1 + r) / (1 - r), where r is their correlation from frame to frame");
    setting(
        &S::sigma_lasting_px, "sigma_lasting_px", "px", between(0, 100),
        "Standard deviation, per axis, of the part of the error of a match that lasts over many frames and is estimated "
        "as a state; 0: all of it is white noise");
    setting(&S::lasting_time_s, "lasting_time_s", "s", above_up_to(0, 1e6),
            "Time in which the correlation of that part falls to 1/e");
    setting(&S::sigma_start_velocity_m_s, "sigma_velocity_m_s", "m/s", between(0, 1e4),
            "Standard deviation of the initial velocity, per axis");
    setting(&S::sigma_start_angular_rate_rad_s, "sigma_angular_rate_rad_s", "rad/s", between(0, 1e4),
            "Standard deviation of the initial angular rate, per axis");
    setting(&S::odometry, "use_odometry", "", any(),
            "Whether the estimator uses the wheel odometry of the vehicle that carries the camera");
    setting(&S::sigma_slip_m_s, "sigma_slip_m_s", "m/s", above_up_to(0, 100),
            "Standard deviation of the vehicle's deviation from rolling without slip, per axis");
    setting(
        &S::invariant, "invariant", "", any(),
        "Whether the errors of the covariance turn with the world (right-invariant filter), so that corrections do not seem "
        "to show the rotation of the whole world");
  }
};

struct SearchSettings {
  int patch_size_px = 11;
  double gate_sigmas = 3.0;
  double min_correlation = 0.8;
  int max_measurements = 0;
  double budget_ms = 20;
  bool anchors_first = false;
  bool align_images = true;
  int levels = 4;
  double max_half_axis_px = 60;
  double gate_probability = 0.99;
  double max_unconfirmed_sigma_px = 8;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = SearchSettings;
    setting(&S::patch_size_px, "patch_size_px", "px", odd_between(9, 15),
            "Side of the square image patch that is matched");
    setting(
        &S::gate_sigmas, "gate_sigmas", "", above_up_to(0, 100),
        "Half axes of the search ellipse in standard deviations of the innovation; those below 1.4 px of the resolution that is searched are widened by up to half a pixel diagonal");
    setting(&S::min_correlation, "min_correlation", "", between(-1, 1),
            "Normalized cross-correlation below which a candidate is no match");
    setting(
        &S::max_measurements, "max_measurements", "", between(0, 10000),
        "Number of features searched per frame, the most uncertain first; 0: map.wanted_visible, or fewer where "
        "they exceed budget_ms");
    setting(
        &S::budget_ms, "budget_ms", "ms", above_up_to(0, 1e5),
        "Time per frame for matching and correction, of one core at 20 Gflop/s, that limits the features searched");
    setting(
        &S::anchors_first, "anchors_first", "", any(),
        "Whether anchors in view, whose measurements inform on the camera alone, are searched for before all others");
    setting(&S::align_images, "align_images", "", any(),
            "Whether successive images are aligned as a whole before features are searched for");
    setting(
        &S::levels, "levels", "", between(1, 4),
        "Resolutions at which large ellipses and blurred images are searched, each half of the one before");
    setting(&S::max_half_axis_px, "max_half_axis_px", "px", above_up_to(0, 16384),
            "Limit of the search in u and in v, from the center of the ellipse");
    setting(&S::gate_probability, "gate_probability", "", between(0.5, 0.999999),
            "Probability that a correct match passes each consistency test");
    setting(&S::max_unconfirmed_sigma_px, "max_unconfirmed_sigma_px", "px", above_up_to(0, 1e9),
            "Predicted standard deviation above which a re-detection stays unconfirmed");
  }
};

struct InitializationSettings {
  enum class Method { inverse_depth, depth_line };
  /// Center of a patch: the intersection of its edges, or the maximum of the corner strength.
  enum class Center { edges, peak };
  enum class Selection {
    grid,       ///< the strongest corners of cells without a feature, over the whole image
    random_box  ///< the strongest corner of a box placed at random, thesis C.3
  };
  /// Where the prior of the depth is that of the landmarks in view.
  enum class ScalePrior { never, nearer, always };

  Method method = Method::inverse_depth;
  int box_width_px = 80;
  int box_height_px = 60;
  double min_corner_strength = 5;
  Center center = Center::edges;
  Selection selection = Selection::grid;
  double look_ahead_s = 0.5;
  double sigma_slope = 0.7;
  int max_new_per_frame = 10;
  int particles = 100;
  double min_depth_m = 0.5;
  double max_depth_m = 5.0;
  double depth_ratio = 0.3;
  int max_line_failures = 10;
  double inverse_depth_per_m = 0.5;
  double sigma_inverse_depth_per_m = 0.5;
  ScalePrior scale_prior_to_view = ScalePrior::nearer;
  double max_linearity = 0.1;
  bool second_order = true;

  DepthRange depth_range() const { return {particles, min_depth_m, max_depth_m}; }

  static void describe(auto&& setting) {
    using namespace limits;
    using S = InitializationSettings;
    setting(&S::method, "method", "", any(), "Parametrization of a new landmark along its line of sight");
    setting(&S::box_width_px, "box_width_px", "px", between(16, 16384),
            "Width of the image box in which a new feature is searched");
    setting(&S::box_height_px, "box_height_px", "px", between(16, 16384),
            "Height of the image box in which a new feature is searched");
    setting(&S::min_corner_strength, "min_corner_strength", "gray^2/px^2", at_least(0),
            "Smaller eigenvalue of the structure tensor that a new feature needs");
    setting(&S::center, "center", "", any(),
            "Center of a patch: intersection of its edges, or maximum of the corner strength");
    setting(
        &S::selection, "selection", "", any(),
        "Choice of new features: strongest corners of a grid without features, or of a box placed at random");
    setting(&S::look_ahead_s, "look_ahead_s", "s", between(0, 100),
            "Time for which a new feature must be predicted to stay in view");
    setting(
        &S::sigma_slope, "sigma_slope", "", between(0, 10),
        "Prior standard deviation of the tangent of a patch's tilt, per axis; 0: patches face the camera");
    setting(&S::max_new_per_frame, "max_new_per_frame", "", between(0, 1000),
            "Number of landmarks initialized per frame");
    setting(&S::particles, "particles", "", between(2, 100000), "Number of depth hypotheses on the ray");
    setting(&S::min_depth_m, "min_depth_m", "m", above_up_to(0, 1e6), "Nearest depth of a new feature");
    setting(&S::max_depth_m, "max_depth_m", "m", above_up_to(0, 1e6), "Farthest depth of a new feature");
    setting(&S::depth_ratio, "depth_ratio", "", above_up_to(0, 1),
            "Ratio of depth sigma to depth below which a ray becomes a point");
    setting(&S::max_line_failures, "max_line_failures", "", between(1, 10000),
            "Consecutive failed searches after which a ray is dropped");
    setting(&S::inverse_depth_per_m, "inverse_depth_per_m", "1/m", between(1e-6, 1000),
            "Prior mean of the inverse depth");
    setting(&S::sigma_inverse_depth_per_m, "sigma_inverse_depth_per_m", "1/m", above_up_to(0, 1000),
            "Prior standard deviation of the inverse depth");
    setting(
        &S::scale_prior_to_view, "scale_prior_to_view", "", any(),
        "Whether mean and standard deviation of this prior are scaled to the median depth of the matched landmarks: never, "
        "where that is nearer, or always; always counts only landmarks of known depth");
    setting(&S::max_linearity, "max_linearity", "", between(0, 10),
            "Linearity index (Civera et al. 2008) below which an inverse depth becomes a point");
    setting(
        &S::second_order, "second_order", "", any(),
        "Whether the product of the errors of inverse depth and camera position counts as measurement noise");
  }
};

struct MapSettings {
  int wanted_visible = 0;
  double max_gap_m = 0;
  int max_landmarks = 500;
  bool replace_when_full = true;
  double max_view_angle_rad = 0.7;
  double max_scale = 1.8;
  int min_attempts = 10;
  double min_matched_share = 0.5;
  int memory_attempts = 10;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = MapSettings;
    setting(
        &S::wanted_visible, "wanted_visible", "", between(0, 10000),
        "Number of landmarks expected to match below which new ones are initialized; 0: by the size of the image, 60 "
        "at 640x480, and of point landmarks all in view");
    setting(
        &S::max_gap_m, "max_gap_m", "m", between(0, 1000),
        "Diameter of the largest area without a landmark, at the distance of the landmarks beside it: larger ones get a new "
        "one, even where enough are in view; 0: no limit");
    setting(&S::max_landmarks, "max_landmarks", "", between(1, 10000), "Limit of the number of landmarks");
    setting(
        &S::replace_when_full, "replace_when_full", "", any(),
        "Whether a full map deletes landmarks out of view for new ones, those with the fewest matches first");
    setting(&S::max_view_angle_rad, "max_view_angle_rad", "rad", above_up_to(0, 3.2),
            "Angle to the initial viewing direction beyond which no match is predicted");
    setting(&S::max_scale, "max_scale", "", above_up_to(1, 100),
            "Ratio to the initial distance, either way, beyond which no match is predicted");
    setting(&S::min_attempts, "min_attempts", "", between(1, 100000),
            "Number of searches before a landmark can be deleted");
    setting(&S::min_matched_share, "min_matched_share", "", between(0, 1),
            "Share of successful searches below which a landmark is deleted");
    setting(
        &S::memory_attempts, "memory_attempts", "", between(0, 100000),
        "Number of recent searches by which a landmark is judged for search, deletion and new landmarks; 0: all "
        "of them, and only for deletion, as in the thesis");
  }
};

/// Of one camera that is the only sensor, with inverse depths and a belief in covariance form.
struct BundleSettings {
  bool adjust = true;
  int window = 15;
  int min_frames = 1;
  double min_motion_share = 0.03;
  double min_start_motion_share = 0.0075;
  double min_matched_share = 0.8;
  int max_iterations = 5;
  double limit_sigmas = 3;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = BundleSettings;
    setting(
        &S::adjust, "adjust", "", any(),
        "Whether bundle adjustment over the last keyframes estimates camera poses and landmarks anew; never with wheel "
        "odometry, position fixes or depth lines");
    setting(&S::window, "window", "", between(2, 1000),
            "Keyframes whose poses an adjustment estimates, at most");
    setting(&S::min_frames, "min_frames", "", between(1, 100000), "Least number of frames between keyframes");
    setting(
        &S::min_motion_share, "min_motion_share", "", between(0, 1),
        "Rms motion of the matched features since the last keyframe, as a share of the image width, from which a "
        "frame becomes a keyframe");
    setting(
        &S::min_start_motion_share, "min_start_motion_share", "", between(0, 1),
        "The same for the first ten keyframes after an origin, if it is less: a wrong start is found earlier. At least three "
        "standard deviations of the pixel noise");
    setting(&S::min_matched_share, "min_matched_share", "", between(0, 1),
            "Share of the features of the last keyframe below which a frame becomes a keyframe");
    setting(&S::max_iterations, "max_iterations", "", between(1, 1000), "Iterations per adjustment");
    setting(&S::limit_sigmas, "limit_sigmas", "", above_up_to(0, 1000),
            "Normalized error of a measurement from which it is weighted down (Huber)");
  }
};

/// Of a lost camera, in the whole map.
struct RelocalizationSettings {
  bool whole_map = true;
  bool close_loops = true;
  int period_frames = 1;
  int min_matches = 6;
  double min_matched_share = 0.55;
  int min_distinctive = 3;
  double min_spread_share = 0.04;
  int confirmations = 3;
  double sigma_velocity_m_s = 0.5;
  double sigma_rate_rad_s = 0.5;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = RelocalizationSettings;
    setting(
        &S::whole_map, "whole_map", "", any(),
        "Whether a lost camera recognizes the whole map by descriptors, besides the search around its last pose");
    setting(
        &S::close_loops, "close_loops", "", any(),
        "Whether a camera that tracks recognizes landmarks that return where it does not expect them, and corrects the drift; "
        "for the only camera, on the only body, without other sensors and with all correlations");
    setting(&S::period_frames, "period_frames", "", between(1, 100000),
            "Frames from one search of the whole map by a lost camera to the next");
    setting(&S::min_matches, "min_matches", "", between(5, 10000),
            "Number of jointly consistent matches in one image that a pose in the map needs");
    setting(&S::min_matched_share, "min_matched_share", "", between(0, 1),
            "Share of the features predicted in view at a pose that must match");
    setting(
        &S::min_distinctive, "min_distinctive", "", between(0, 10000),
        "Number of matches that a pose needs in which neither another corner nor another landmark looks alike");
    setting(
        &S::min_spread_share, "min_spread_share", "", between(0, 1),
        "Rms distance of the matches from a line in the image, as a share of its width, that a pose needs");
    setting(&S::confirmations, "confirmations", "", between(1, 1000),
            "Consecutive frames that must find the same pose");
    setting(&S::sigma_velocity_m_s, "sigma_velocity_m_s", "m/s", above_up_to(0, 1000),
            "Standard deviation of the velocity between these frames, per axis");
    setting(&S::sigma_rate_rad_s, "sigma_rate_rad_s", "rad/s", above_up_to(0, 1000),
            "Standard deviation of the angular rate between these frames, per axis");
  }
};

struct StartSettings {
  enum class From {
    target,  ///< pose solved from the known target
    free     ///< the first view is the origin
  };
  From from = From::target;
  std::string target;
  double max_search_s = 10;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = StartSettings;
    setting(
        &S::from, "from", "", any(),
        "Origin of the world frame: a known target, from which the initial pose is solved, or the first view");
    setting(&S::target, "target", "", any(), "Target file, beside the scenario or under the data folder");
    setting(&S::max_search_s, "max_search_s", "s", above_up_to(0, 1e6),
            "Time after which the state is `lost` if the target was not found");
  }
};

struct CameraSlamSettings {
  FilterSettings filter;
  SearchSettings search;
  InitializationSettings initialization;
  MapSettings map;
  BundleSettings bundle;
  RelocalizationSettings relocalization;
  HealthSettings health{.max_sigma_position_m = 0.5};
};

}  // namespace incognita
