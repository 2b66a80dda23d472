// Gray-level canvas in meters, on which the textures of the rendered room are painted.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

/// x to the right, y down, from the top left corner; gray levels from 0 to 255. Shapes have antialiased edges
/// one texel wide and are clipped to the canvas.
class Canvas {
 public:
  using Point = Eigen::Vector2d;

  Canvas(double width_m, double height_m, double texel_m, double gray);

  double width_m() const { return width_ * texel_m_; }
  double height_m() const { return height_ * texel_m_; }

  /// Adds smooth value noise with one random value, uniform in +-amplitude, per cell.
  void add_noise(RandomStream& random, double cell_m, double amplitude);
  /// Fills a convex polygon; corners clockwise as seen (y down).
  void polygon(std::span<const Point> corners, double gray);
  void disc(const Point& center, double radius_m, double gray);
  /// Multiplies every texel from `low` to `high` by a factor of its position: light and shadow.
  template <class Factor>
  void light(const Point& low, const Point& high, Factor factor);

  Image image() const;

 private:
  template <class Change>
  void change(const Point& low, const Point& high, Change change);

  int width_, height_;
  double texel_m_;
  std::vector<float> gray_;
};

template <class Change>
void Canvas::change(const Point& low, const Point& high, Change change) {
  const auto texel = [&](double x, int count) {
    return std::clamp(static_cast<int>(x / texel_m_), 0, count - 1);
  };
  const int u0 = texel(low.x() - texel_m_, width_), u1 = texel(high.x() + texel_m_, width_);
  const int v0 = texel(low.y() - texel_m_, height_), v1 = texel(high.y() + texel_m_, height_);
  for (int v = v0; v <= v1; ++v)
    for (int u = u0; u <= u1; ++u) {
      float& gray = gray_[static_cast<std::size_t>(v) * width_ + u];
      gray = static_cast<float>(change(gray, Point((u + 0.5) * texel_m_, (v + 0.5) * texel_m_)));
    }
}

template <class Factor>
void Canvas::light(const Point& low, const Point& high, Factor factor) {
  change(low, high, [&](double gray, const Point& p) { return gray * factor(p.x(), p.y()); });
}

}  // namespace incognita
