// A camera that looks out of a circle in the rendered room and turns around several times, for trials of loop closure.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "incognita/models/motion/heading.hpp"

namespace incognita::turning_camera {

inline constexpr double period_s = 20, radius_m = 0.8, rate_hz = 30, focal_px = 195;

/// Its motion in TUM format, slightly up and down.
inline std::string trajectory(double turns) {
  std::string text;
  for (int k = 0; k <= turns * period_s * rate_hz; ++k) {
    const double t = k / rate_hz, angle = 2 * std::numbers::pi * t / period_s;
    const Eigen::Vector4d q = level_gaze(angle);
    text += fmt::format("{:.4f} {:.6f} {:.6f} {:.6f} {:.7f} {:.7f} {:.7f} {:.7f}\n", t,
                        radius_m * std::cos(angle), radius_m * std::sin(angle), 0.1 * std::sin(3.3 * angle),
                        q[1], q[2], q[3], q[0]);
  }
  return text;
}

/// With the trajectory in the file turning.tum beside it. The focal length is focal_px in the world; that of the estimator
/// may differ. `focal`: px.
inline std::string scenario(double turns, double focal) {
  return fmt::format(
      "[run]\nduration_s = {}\nrate_hz = {}\n[motion]\ntype = \"trajectory\"\nfile = \"turning.tum\"\n"
      "[room]\nsize_m = [6.0, 6.0, 2.5]\nstart_position_m = [0.8, 0.0, 1.3]\nsigma_image_gray = 2\n"
      "[camera]\nmodel = \"pinhole\"\nwidth_px = 320\nheight_px = 240\nfu_px = {}\nfv_px = {}\nu0_px = 159.5\n"
      "v0_px = 119.5\n[start]\nfrom = \"free\"\n[decision]\nstrategy = \"none\"\n",
      turns * period_s, rate_hz, focal, focal);
}

}  // namespace incognita::turning_camera
