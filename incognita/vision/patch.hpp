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

/// Warps the texture by the 2x2 matrix `texture_from_view` (texture pixels per view pixel) to a patch of side `size`.
/// Nothing when that needs pixels outside the texture, or the patch has no contrast.
std::optional<PatchTemplate> warp(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view,
                                  int size);

}  // namespace incognita
