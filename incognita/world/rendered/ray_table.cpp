#include "incognita/world/rendered/ray_table.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

/// Side of the square with the pixel's solid angle, per unit of ray parameter.
double pixel_side(const Camera& camera, const Eigen::Vector3d& ray, int u, int v) {
  const auto right = camera.unproject({u + 0.5, v}), left = camera.unproject({u - 0.5, v});
  const auto below = camera.unproject({u, v + 0.5}), above = camera.unproject({u, v - 0.5});
  if (!right || !left || !below || !above) return 0;
  const double volume = std::abs((*right - *left).cross(*below - *above).dot(ray));
  return std::sqrt(volume / ray.norm());
}

/// Bounding cone of a tile's rays, with a margin for rays within a pixel.
RayTable::Cone tile_cone(const RayTable& table, int tile_u, int tile_v) {
  const int u0 = tile_u * RayTable::tile_px, u1 = std::min(u0 + RayTable::tile_px, table.width);
  const int v0 = tile_v * RayTable::tile_px, v1 = std::min(v0 + RayTable::tile_px, table.height);
  const auto direction = [&](int u, int v) {
    return Eigen::Vector3f(table.x[table.index(u, v)], table.y[table.index(u, v)], 1).normalized();
  };
  RayTable::Cone cone;
  cone.axis.setZero();
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u)
      if (table.has_ray(u, v)) cone.axis += direction(u, v);
  if (cone.axis.isZero()) return cone;
  cone.axis.normalize();
  float least_cosine = 1, largest_footprint = 0;
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) {
      if (!table.has_ray(u, v)) continue;
      least_cosine = std::min(least_cosine, cone.axis.dot(direction(u, v)));
      largest_footprint = std::max(largest_footprint, table.footprint[table.index(u, v)]);
    }
  const float half_angle = std::acos(std::min(least_cosine, 1.0f)) + largest_footprint + 1e-3f;
  cone.sin_half_angle = half_angle < 1.5f ? std::sin(half_angle) : 1.0f;
  return cone;
}

}  // namespace

RayTable::RayTable(const Camera& camera)
    : width(camera.width()),
      height(camera.height()),
      tiles_across((width + tile_px - 1) / tile_px),
      tiles_down((height + tile_px - 1) / tile_px),
      stride(tiles_across * tile_px) {
  const std::size_t count = static_cast<std::size_t>(stride) * height;
  x.resize(count);
  y.resize(count);
  footprint.resize(count);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const auto ray = camera.unproject({u, v});
      if (!ray) continue;
      x[index(u, v)] = static_cast<float>(ray->x());
      y[index(u, v)] = static_cast<float>(ray->y());
      footprint[index(u, v)] = static_cast<float>(pixel_side(camera, *ray, u, v));
    }
  for (int v = 0; v < tiles_down; ++v)
    for (int u = 0; u < tiles_across; ++u) cones.push_back(tile_cone(*this, u, v));
}

}  // namespace incognita
