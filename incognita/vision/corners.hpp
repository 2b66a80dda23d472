// Shi and Tomasi's corners: where a patch differs from itself moved by a little in any direction.
#pragma once

#include <Eigen/Core>
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

/// The point that the edges in the window run through (W. Foerstner, E. Guelch 1987): there, and not where
/// the window just has the corner in it somewhere, a patch that is stretched or sheared about its centre
/// stays in its place. Nothing when that point is not in the window around `near`. A square of `left_out_px`
/// in the middle is left out: there a blurred corner is rounded, which draws the point inwards.
std::optional<Eigen::Vector2d> center_of_corner(const Image& image, const Eigen::Vector2d& near,
                                                int window_px, int left_out_px = 0);

}  // namespace incognita
