// A grey texture with a pyramid of halved copies, so that it can be sampled at any distance without aliasing.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

class Texture {
 public:
  Texture() = default;
  explicit Texture(const Image& finest);

  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }

  /// 256 times the grey level at (u, v) texels, the centre of the first texel at 0,0, averaged over about
  /// `footprint` texels (trilinear). Points outside take the nearest edge's value.
  int sample(float u, float v, float footprint) const {
    if (footprint <= 1.0f) return bilinear(levels_[0], u, v);
    // log2 in 1/256, read off the float's exponent and mantissa: within 0.09 of the true one, and monotone
    const int log2_256 = static_cast<int>((std::bit_cast<std::uint32_t>(footprint) - 0x3f800000u) >> 15);
    const int level = log2_256 >> 8;
    if (level >= count_ - 1) return at_level(count_ - 1, u, v);
    const int weight = log2_256 & 255;
    const int fine = at_level(level, u, v), coarse = at_level(level + 1, u, v);
    return fine + (((coarse - fine) * weight) >> 8);
  }

 private:
  /// Each number holds a texel (low byte) and the one below it (high byte), so that two numbers are all that
  /// bilinear sampling reads. A texel is repeated at the right, so that it needs no test there.
  struct Level {
    std::size_t offset = 0;
    int width = 0, height = 0;
    float scale = 1;  ///< texels of this level per finest texel
  };
  static constexpr int max_levels = 10;

  void append(const Image& level, float scale);

  int at_level(int level, float u, float v) const {
    const Level& l = levels_[level];
    return bilinear(l, (u + 0.5f) * l.scale - 0.5f, (v + 0.5f) * l.scale - 0.5f);
  }
  int bilinear(const Level& l, float u, float v) const {
    const int fu = static_cast<int>(std::min(std::max(u, 0.0f), static_cast<float>(l.width - 1)) * 256.0f);
    const int fv = static_cast<int>(std::min(std::max(v, 0.0f), static_cast<float>(l.height - 1)) * 256.0f);
    const std::uint16_t* p =
        pairs_.data() + l.offset + static_cast<std::size_t>(fv >> 8) * (l.width + 1) + (fu >> 8);
    const unsigned a = fu & 255, b = fv & 255;
    const std::uint32_t four = p[0] | static_cast<std::uint32_t>(p[1]) << 16;
    const std::uint32_t columns = (four & 0x00ff00ff) * (256 - b) + ((four >> 8) & 0x00ff00ff) * b;
    return static_cast<int>(((columns & 0xffff) * (256 - a) + (columns >> 16) * a) >> 8);
  }

  std::vector<std::uint16_t> pairs_;
  std::array<Level, max_levels> levels_{};
  int count_ = 0;
};

}  // namespace incognita
