// The ray of every pixel of a camera, worked out once.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/models/camera.hpp"

namespace incognita {

/// Pixels are grouped in square tiles with a cone around the rays of each, so that what a tile cannot see is
/// found out once per tile and not once per pixel.
struct RayTable {
  static constexpr int tile_px = 8;

  struct Ray {
    float x = 0, y = 0;  ///< the ray is (x, y, 1) in camera axes
    float footprint =
        0;               ///< side of the pixel, seen face on, per unit of ray parameter; 0: no ray reaches it
    float reserved = 0;  ///< makes a ray 16 bytes
  };
  struct Cone {
    Eigen::Vector3f axis{0, 0, 1};  ///< unit, camera axes
    float sin_half_angle = 0;
  };

  explicit RayTable(const Camera& camera);

  const Ray& at(int u, int v) const { return rays[static_cast<std::size_t>(v) * width + u]; }

  int width = 0, height = 0;
  int tiles_across = 0, tiles_down = 0;
  std::vector<Ray> rays;    ///< row by row
  std::vector<Cone> cones;  ///< of the tiles, row by row
};

}  // namespace incognita
