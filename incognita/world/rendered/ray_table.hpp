// Precomputed rays of all pixels of a camera.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/models/sensors/camera.hpp"

namespace incognita {

/// Pixels are grouped in square tiles with a bounding cone of their rays, so that visibility is culled once
/// per tile and not per pixel.
struct RayTable {
  static constexpr int tile_px = 8;

  struct Cone {
    Eigen::Vector3f axis{0, 0, 1};  ///< unit, camera axes
    float sin_half_angle = 0;
  };

  explicit RayTable(const Camera& camera);

  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * stride + u; }
  bool has_ray(int u, int v) const { return footprint[index(u, v)] > 0; }

  int width = 0, height = 0;
  int tiles_across = 0, tiles_down = 0;
  int stride = 0;  ///< row length of the arrays below: whole tiles
  /// The ray of a pixel is (x, y, 1) in camera axes. Its footprint is the side of the pixel seen face on, per
  /// unit of ray parameter; 0 if the pixel has no ray.
  std::vector<float> x, y, footprint;
  std::vector<Cone> cones;  ///< one per tile, row by row
};

}  // namespace incognita
