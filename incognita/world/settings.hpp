// Settings of the rendered room, and of an operator who moves a camera in it or elsewhere.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/math/setting.hpp"

namespace incognita {

struct RoomSettings {
  Eigen::Vector3d size_m{6.0, 6.0, 2.5};
  int boxes = 6;
  Eigen::Vector3d start_position_m{1.6, 0.0, 1.3};
  double start_heading_rad = 0.0;
  double sigma_start_position_m = 0.05;
  double sigma_start_heading_rad = 0.03;
  double sigma_image_gray = 2.0;
  double sigma_acceleration_m_s2 = 0.3;
  double sigma_angular_acceleration_rad_s2 = 0.3;
  double clearance_m = 0.15;
  double cover_lens_from_s = -1;
  double texel_m = 0.0045;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = RoomSettings;
    setting(&S::size_m, "size_m", "m", between(1.8, 50), "Interior of the room: +-x/2, +-y/2, 0 to z");
    setting(&S::boxes, "boxes", "", between(0, 24),
            "Number of textured boxes that stand on the floor along the walls");
    setting(&S::start_position_m, "start_position_m", "m", between(-1000, 1000),
            "Nominal initial position of the camera");
    setting(&S::start_heading_rad, "start_heading_rad", "rad", between(-6.3, 6.3),
            "Nominal initial heading about z, from the x axis, along which the target is");
    setting(&S::sigma_image_gray, "sigma_image_gray", "gray", between(0, 100),
            "Standard deviation of the image noise in gray levels");
    setting(&S::clearance_m, "clearance_m", "m", between(0, 0.5),
            "Least distance of the camera, or of its vehicle's axle, from walls and boxes");
    setting(&S::texel_m, "texel_m", "m", between(0.001, 0.05),
            "Side of a texel of the walls; a pixel should cover one or more: the distance over camera.fu_px");
    setting(&S::cover_lens_from_s, "cover_lens_from_s", "s", any(),
            "Time from which the lens is covered; negative: never");
    setting(&S::sigma_start_position_m, "sigma_start_position_m", "m", between(0, 10),
            "Standard deviation of the true initial position about the nominal one, per axis");
    setting(&S::sigma_start_heading_rad, "sigma_start_heading_rad", "rad", between(0, 3.2),
            "Standard deviation of the true initial heading about the nominal one");
    setting(
        &S::sigma_acceleration_m_s2, "sigma_acceleration_m_s2", "m/s^2", between(0, 1000),
        "Standard deviation of the true disturbance of the acceleration per axis, constant over one frame");
    setting(&S::sigma_angular_acceleration_rad_s2, "sigma_angular_acceleration_rad_s2", "rad/s^2",
            between(0, 1000),
            "Standard deviation of the true disturbance of the angular acceleration per axis");
  }
};

/// Exposure of the simulated camera in the rendered room. Time stamps are the middle of the exposure of the middle row.
struct ExposureSettings {
  double duration_s = 0;
  double readout_s = 0;
  double step_ratio = 1;
  std::vector<double> step_times_s{};
  double step_interval_s = 2;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = ExposureSettings;
    setting(&S::duration_s, "duration_s", "s", between(0, 0.5),
            "Exposure of each row; motion blurs the image");
    setting(&S::readout_s, "readout_s", "s", between(0, 0.5),
            "Time from the first row to the last of a rolling shutter; 0: global shutter");
    setting(&S::step_ratio, "step_ratio", "", between(1, 4),
            "Largest ratio of the brightness after a step of the exposure to that at the start; 1: no steps");
    setting(&S::step_times_s, "step_times_s", "s", between(0, 1e7),
            "Times at which the brightness rises by step_ratio and falls back, in turn; empty: random times");
    setting(&S::step_interval_s, "step_interval_s", "s", above_up_to(0, 1e7),
            "Mean time between random steps, each to a brightness between 1 / step_ratio and step_ratio");
  }
};

/// Operator who moves the camera by hand as shown on a screen, thesis 6.3.2.
struct OperatorSettings {
  bool holds = false;
  double delay_s = 0.3;
  double wrong = 0;
  double sigma_way_ratio = 0.2;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = OperatorSettings;
    setting(&S::holds, "holds", "", any(),
            "Whether an operator moves the camera by hand as the screen shows, unknown to the estimator");
    setting(&S::delay_s, "delay_s", "s", between(0, 100), "Delay from the displayed action to the motion");
    setting(&S::wrong, "wrong_probability", "", between(0, 1),
            "Probability of a motion in another of the six directions");
    setting(&S::sigma_way_ratio, "sigma_length_ratio", "", between(0, 10),
            "Standard deviation of the length moved over the length displayed");
  }
};

}  // namespace incognita
