// Terrain for tests.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/models/motion/terrain.hpp"

namespace incognita::grounds {

/// Slope of 73 degrees.
inline Terrain steep_slope() { return TiltedPlane{.height_m = 2, .slope_x = -2.5, .slope_y = 2}; }

/// Slopes up to 0.5.
inline Terrain gentle_waves() {
  return Waves{.height_m = -1,
               .waves = {{.amplitude_m = 1, .length_m = 20, .direction_rad = 0.3},
                         {.amplitude_m = 0.5, .length_m = 15, .direction_rad = 1.9, .phase_rad = 1}}};
}

/// Slopes up to 4 (76 degrees).
inline Terrain steep_waves() {
  return Waves{.waves = {{.amplitude_m = 1, .length_m = 3, .direction_rad = 0},
                         {.amplitude_m = 0.8, .length_m = 2.5, .direction_rad = 1.7, .phase_rad = 2}}};
}

/// Smooth hills, 18 m by 30 m around the origin.
inline Terrain small_height_map() {
  Eigen::MatrixXd heights(7, 11);
  for (int i = 0; i < heights.rows(); ++i)
    for (int k = 0; k < heights.cols(); ++k)
      heights(i, k) = std::sin(0.9 * i) + 0.7 * std::cos(1.1 * k - 0.4 * i);
  return HeightMap(heights, 3, {-9, -15});
}

}  // namespace incognita::grounds
