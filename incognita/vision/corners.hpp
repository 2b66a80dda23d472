// Shi-Tomasi corners: windows that differ from every slightly shifted copy of themselves.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

/// Corners nearer to each other than this are one corner: patches are wider, so that new landmarks begin farther apart.
inline constexpr double same_corner_px = 3;

struct PixelBox {
  int u = 0, v = 0;  ///< first column and row
  int width = 0, height = 0;
};

struct Corner {
  int u = 0, v = 0;
  double strength = 0;  ///< smaller eigenvalue of the mean structure tensor, gray levels^2 / px^2
};

/// The strongest corner whose center lies in the box; nothing when the box contains no pixel of the image.
/// `window_px` (odd) is the side of the square over which gradients are averaged.
std::optional<Corner> strongest_corner(const Image& image, const PixelBox& box, int window_px);

/// Corner strengths of a whole image, for many boxes.
class CornerMap {
 public:
  /// `window_px` as above. Allocates only when the size of the images changes.
  void assign(const Image& image, int window_px);
  /// As strongest_corner() of the image, up to what lies at the border of the box.
  std::optional<Corner> strongest(const PixelBox& box) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> strengths_;
};

/// The corners of the whole image whose strength is the largest within `apart_px` in u and in v, and at least
/// `min_strength`: at most `max_count`, the strongest first. `margin_px`: distance from the border of the image.
std::vector<Corner> strong_corners(const Image& image, int window_px, double min_strength, int apart_px,
                                   int margin_px, int max_count);

/// The intersection of the edges in the window (W. Foerstner, E. Guelch 1987). A patch centered at this point keeps
/// its position under stretch and shear. Returns nothing when the point is not in the window around `near`. The
/// central square of `left_out_px` is ignored: a blurred corner is rounded there, which biases the point inwards.
std::optional<Eigen::Vector2d> center_of_corner(const Image& image, const Eigen::Vector2d& near,
                                                int window_px, int left_out_px = 0);

}  // namespace incognita
