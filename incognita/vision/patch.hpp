// Image patches of landmarks, and their warp to another view.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "incognita/vision/image.hpp"

namespace incognita {

inline constexpr int max_patch_size = 15;

/// The image around a landmark at its initialization, larger than the matched patch so that it can be warped.
struct PatchTexture {
  Image pixels;
  Eigen::Vector2d center;  ///< position of the landmark in `pixels`, px
};

/// A patch prepared for correlation: zero mean, rows padded to 16 for one vector operation per row.
struct PatchTemplate {
  static constexpr int row_stride = 16;
  int size = 0;  ///< side, px, odd
  std::array<std::int16_t, max_patch_size * row_stride>
      values{};     ///< 8 * (pixel - mean), zero in the padding
  int sum = 0;      ///< of the values: the rounding error of the mean
  double norm = 0;  ///< square root of the sum of (value - sum / size^2)^2
};

/// Copies a square of `side` pixels around `center`, cropped to the image.
/// Nothing when the landmark is nearer than `core_px` to the image border.
std::optional<PatchTexture> cut_texture(const Image& image, const Eigen::Vector2d& center, int side,
                                        int core_px);

/// The texture of a landmark as another view shows it. Each pixel of the view is the mean over the area of the texture that it
/// covers: where the view is farther away, single samples would make edges too steep, and corners would be found beside
/// their places.
class WarpedTexture {
 public:
  /// `texture_from_view`: texture pixels per view pixel, 2x2. Keeps a reference to the texture.
  WarpedTexture(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view);

  /// Whether the square of the view around the landmark, of this half side in view pixels, lies in the texture, but for half
  /// a texture pixel. False if the warp is not finite.
  bool covers(double half_px) const;
  /// Gray value at `off` view pixels from the landmark. Only for a warp that covers something.
  double at(const Eigen::Vector2d& off) const;

 private:
  /// Samples on both sides of a pixel's center along one principal axis of its area.
  struct Samples {
    int count = 1;
    Eigen::Vector2d first{0, 0}, step{0, 0};  ///< texture px
  };
  static Samples along(const Eigen::Vector2d& axis, double length);

  const PatchTexture& texture_;
  Eigen::Matrix2d texture_from_view_;
  std::array<Samples, 2> samples_;
};

/// Warps the texture by the 2x2 matrix `texture_from_view` (texture pixels per view pixel) to a patch of side `size`.
/// Nothing when that needs pixels outside the texture, or the patch has no contrast.
std::optional<PatchTemplate> warp(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view,
                                  int size);

}  // namespace incognita
