// Image patches: what a landmark looks like, and what it should look like from elsewhere.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "incognita/vision/image.hpp"

namespace incognita {

inline constexpr int max_patch_size = 15;

/// A piece of the image a landmark was first seen in, larger than what is compared so that it can be warped.
struct PatchTexture {
  Image pixels;
  Eigen::Vector2d center;  ///< where in `pixels` the landmark is, px
};

/// A patch ready to be searched for: mean taken off, rows padded to 16 so that one vector operation takes a
/// row.
struct PatchTemplate {
  static constexpr int row_stride = 16;
  int size = 0;  ///< side, odd
  std::array<std::int16_t, max_patch_size * row_stride>
      values{};     ///< 8 * (pixel - mean), zero in the padding
  int sum = 0;      ///< of the values: what rounding left of the mean
  double norm = 0;  ///< square root of the sum of (value - sum / size^2)^2
};

/// Cuts a square of `side` pixels around a place in the image, or as much of it as there is.
/// Nothing when the landmark itself would be nearer than `core_px` to the edge of the image.
std::optional<PatchTexture> cut_texture(const Image& image, const Eigen::Vector2d& center, int side,
                                        int core_px);

/// What the texture looks like when one pixel of the view is `texture_from_view` pixels of the texture (2x2).
/// Nothing when that needs pixels that were not stored, or the patch has no contrast.
std::optional<PatchTemplate> warp(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view,
                                  int size);

}  // namespace incognita
