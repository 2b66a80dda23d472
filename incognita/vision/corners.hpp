// Shi and Tomasi's corners: where a patch differs from itself moved by a little in any direction.
#pragma once

#include <optional>

#include "incognita/vision/image.hpp"

namespace incognita {

struct PixelBox {
  int u = 0, v = 0;  ///< first column and row
  int width = 0, height = 0;
};

struct Corner {
  int u = 0, v = 0;
  double strength =
      0;  ///< smaller eigenvalue of the mean gradient product over the patch, grey levels^2 / px^2
};

/// The strongest corner whose centre lies in the box; nothing when the box holds no pixel of the image.
/// `window_px` is the side of the square that gradients are averaged over, odd.
std::optional<Corner> strongest_corner(const Image& image, const PixelBox& box, int window_px);

}  // namespace incognita
