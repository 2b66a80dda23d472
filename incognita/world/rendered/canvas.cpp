#include "incognita/world/rendered/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

/// Position of a texel between the cells of a noise lattice.
struct Between {
  int cell;
  float weight;
};

std::vector<Between> between_cells(int count, double texels_per_cell) {
  std::vector<Between> out(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double x = i / texels_per_cell, f = x - std::floor(x);
    out[i] = {static_cast<int>(x), static_cast<float>(f * f * (3 - 2 * f))};
  }
  return out;
}

/// Antialiased blend: an edge covers this texel partially if it is less than half a texel away.
double covered(double under, double over, double outside_texels) {
  return under + std::clamp(0.5 - outside_texels, 0.0, 1.0) * (over - under);
}

}  // namespace

Canvas::Canvas(double width_m, double height_m, double texel_m, double gray)
    : width_(std::max(1, static_cast<int>(std::lround(width_m / texel_m)))),
      height_(std::max(1, static_cast<int>(std::lround(height_m / texel_m)))),
      texel_m_(texel_m),
      gray_(static_cast<std::size_t>(width_) * height_, static_cast<float>(gray)) {}

void Canvas::add_noise(RandomStream& random, double cell_m, double amplitude) {
  const std::vector<Between> across = between_cells(width_, cell_m / texel_m_);
  const std::vector<Between> down = between_cells(height_, cell_m / texel_m_);
  const int columns = across.back().cell + 2, rows = down.back().cell + 2;
  std::vector<float> lattice(static_cast<std::size_t>(columns) * rows);
  for (float& value : lattice) value = static_cast<float>(random.uniform(-amplitude, amplitude));
  std::vector<float> line(static_cast<std::size_t>(columns));
  for (int v = 0; v < height_; ++v) {
    const float* upper = &lattice[static_cast<std::size_t>(down[v].cell) * columns];
    for (int c = 0; c < columns; ++c) line[c] = upper[c] + down[v].weight * (upper[c + columns] - upper[c]);
    float* out = &gray_[static_cast<std::size_t>(v) * width_];
    for (int u = 0; u < width_; ++u) {
      const float* value = &line[across[u].cell];
      out[u] += value[0] + across[u].weight * (value[1] - value[0]);
    }
  }
}

void Canvas::polygon(std::span<const Point> corners, double gray) {
  struct Edge {
    Point from, outward;
  };
  std::vector<Edge> edges;
  Point low = corners[0], high = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point along = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
    edges.push_back({corners[i], {along.y(), -along.x()}});
    low = low.cwiseMin(corners[i]);
    high = high.cwiseMax(corners[i]);
  }
  change(low, high, [&](double under, const Point& p) {
    double outside_m = -1e9;
    for (const Edge& edge : edges) outside_m = std::max(outside_m, edge.outward.dot(p - edge.from));
    return covered(under, gray, outside_m / texel_m_);
  });
}

void Canvas::disc(const Point& center, double radius_m, double gray) {
  const Point reach = Point::Constant(radius_m);
  change(center - reach, center + reach, [&](double under, const Point& p) {
    return covered(under, gray, ((p - center).norm() - radius_m) / texel_m_);
  });
}

Image Canvas::image() const {
  Image out(width_, height_);
  std::transform(gray_.begin(), gray_.end(), out.row(0),
                 [](float g) { return static_cast<std::uint8_t>(std::clamp(g, 0.0f, 255.0f) + 0.5f); });
  return out;
}

}  // namespace incognita
