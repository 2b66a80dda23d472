#include "incognita/app/loop/world_outline.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {

CameraIntrinsics intrinsics_of(const CameraSettings& camera) {
  return {camera.width_px, camera.height_px, camera.fu_px, camera.fv_px, camera.u0_px, camera.v0_px};
}

RoomOutline outline_of(const RoomLayout& layout) {
  RoomOutline room{{layout.inside.min, layout.inside.max}, {}};
  for (const Box& box : layout.boxes) room.boxes.push_back({box.min, box.max});
  return room;
}

std::optional<TerrainGrid> terrain_grid(const Terrain& ground, const Eigen::Vector2d& min_m,
                                        const Eigen::Vector2d& max_m) {
  constexpr int most_points = 64;  // per axis
  const Eigen::Vector2d size = max_m - min_m;
  TerrainGrid grid;
  grid.origin_m = min_m;
  grid.step_m = size.maxCoeff() / (most_points - 1);
  const auto points = [&](double length) { return 1 + static_cast<int>(std::lround(length / grid.step_m)); };
  grid.columns = points(size.x()), grid.rows = points(size.y());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d at = min_m + grid.step_m * Eigen::Vector2d(column, row);
      grid.heights_m.push_back(ground.at<double>(at.x(), at.y()).height);
    }
  const bool flat = std::ranges::all_of(grid.heights_m, [](double height) { return height == 0; });
  return flat ? std::nullopt : std::optional(std::move(grid));
}

std::optional<double> mean_rate_hz(const std::vector<double>& times) {
  if (times.size() < 2 || !(times.back() > times.front())) return std::nullopt;
  return static_cast<double>(times.size() - 1) / (times.back() - times.front());
}

}  // namespace incognita
