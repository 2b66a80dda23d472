// Images of a painted plane, each pixel the mean over the area that it covers.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/vision/image.hpp"

namespace incognita {

/// The image in which the plane's origin is at `origin`, px; `plane_from_view`: plane units per pixel, 2x2. `gray_at` takes a point
/// of the plane.
template <class Gray>
Image drawn(Gray gray_at, const Eigen::Matrix2d& plane_from_view, const Eigen::Vector2d& origin,
            int side = 61) {
  constexpr int rows = 12;
  Image image(side, side);
  for (int v = 0; v < side; ++v)
    for (int u = 0; u < side; ++u) {
      double sum = 0;
      for (int k = 0; k < rows * rows; ++k) {
        const Eigen::Vector2d in_pixel((k % rows + 0.5) / rows - 0.5, (k / rows + 0.5) / rows - 0.5);
        const Eigen::Vector2d at = plane_from_view * (Eigen::Vector2d(u, v) + in_pixel - origin);
        sum += gray_at(at);
      }
      image(u, v) = static_cast<std::uint8_t>(std::lround(sum / (rows * rows)));
    }
  return image;
}

/// The corner of a dark rectangle whose edges are turned by `angle_rad`.
struct DarkCorner {
  double angle_rad = 0;
  double operator()(const Eigen::Vector2d& at) const {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return c * at.x() + s * at.y() > 0 && c * at.y() - s * at.x() > 0 ? 14 : 236;
  }
};

}  // namespace incognita
