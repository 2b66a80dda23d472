// Sinusoidal panning of a camera about the vertical.
#pragma once

#include <cmath>
#include <numbers>

namespace incognita {

/// Heading of a camera about z from +x, positive to the left, and elevation of its optical axis above the horizon, with
/// their rates.
struct Heading {
  double rad = 0;
  double rate_rad_s = 0;
  double elevation_rad = 0;
  double elevation_rate_rad_s = 0;
};

struct GazeSwing {
  double amplitude_rad = 0;
  double period_s = 20;

  /// `t`: s since the camera passed `middle_rad` to the left.
  Heading at(double middle_rad, double t) const {
    const double phase = 2 * std::numbers::pi * t / period_s;
    return {middle_rad + amplitude_rad * std::sin(phase),
            amplitude_rad * std::cos(phase) * 2 * std::numbers::pi / period_s};
  }
};

}  // namespace incognita
