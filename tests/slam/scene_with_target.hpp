// A wall with a black rectangle on a white sheet, and the target that says so.
#pragma once

#include "incognita/slam/features/target.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {

inline constexpr double sheet_half_width_m = 0.21, sheet_half_height_m = 0.15;

inline const Wall& wall_with_sheet() {
  static const Wall wall = [] {
    Wall made(1.4, 1);
    made.hang_sheet(sheet_half_width_m, sheet_half_height_m, 0.1);
    return made;
  }();
  return wall;
}

/// The rectangle's corners; their patches are what a camera sees of them straight on.
inline Target sheet_target() {
  Target target;
  target.name = "sheet";
  target.normal = {-1, 0, 0};
  const CameraState before = camera_at({0.1, 0, 0});
  const Image image = wall_with_sheet().seen_from(before);
  for (const auto& [y, z] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Eigen::Vector3d at(wall_with_sheet().distance_m(), y * sheet_half_width_m, z * sheet_half_height_m);
    const Eigen::Vector2d pixel = pixel_of(before, at);
    Image patch(11, 11);
    for (int v = 0; v < 11; ++v)
      for (int u = 0; u < 11; ++u)
        patch(u, v) =
            static_cast<std::uint8_t>(std::lround(image.sample(pixel.x() + u - 5, pixel.y() + v - 5)));
    target.corners.push_back({at, patch});
  }
  return target;
}

}  // namespace incognita::synthetic
