// Gray-level texture with a mipmap pyramid, for sampling at any distance without aliasing.
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

  /// 256 times the gray level at a point, averaged over about `footprint` texels. Coordinates are in 1/256
  /// texel; the center of the first texel is 0,0. Points outside are clamped to the edge.
  int sample(int u, int v, float footprint) const {
    if (footprint <= 1.0f) return bilinear(0, u, v);
    // log2 in 1/256 from the float's exponent and mantissa: error below 0.09, monotone
    const int log2_256 = static_cast<int>((std::bit_cast<std::uint32_t>(footprint) - 0x3f800000u) >> 15);
    const int level = log2_256 >> 8;
    if (level >= count_ - 1) return bilinear(count_ - 1, u, v);
    // Blends two levels, except close to one of them, where one suffices at half the cost.
    const int weight = (log2_256 & 255) - 64;
    if (weight <= 0) return bilinear(level, u, v);
    if (weight >= 128) return bilinear(level + 1, u, v);
    const int fine = bilinear(level, u, v), coarse = bilinear(level + 1, u, v);
    return fine + (((coarse - fine) * weight) >> 7);
  }

 private:
  /// Each number holds a texel (low byte) and the one below it (high byte), so that bilinear sampling reads
  /// only two numbers. The last column is repeated, so that it needs no bounds check.
  struct Level {
    std::size_t offset = 0;
    int width = 0, height = 0;
  };
  static constexpr int max_levels = 10;

  void append(const Image& level);

  int bilinear(int level, int u, int v) const {
    const Level& l = levels_[level];
    u = std::clamp(((u + 128) >> level) - 128, 0, (l.width - 1) << 8);
    v = std::clamp(((v + 128) >> level) - 128, 0, (l.height - 1) << 8);
    const std::uint16_t* p = pairs_.data() + l.offset + (v >> 8) * (l.width + 1) + (u >> 8);
    const unsigned a = u & 255, b = v & 255;
    const std::uint32_t four = p[0] | static_cast<std::uint32_t>(p[1]) << 16;
    const std::uint32_t columns = (four & 0x00ff00ff) * (256 - b) + ((four >> 8) & 0x00ff00ff) * b;
    return static_cast<int>(((columns & 0xffff) * (256 - a) + (columns >> 16) * a) >> 8);
  }

  std::vector<std::uint16_t> pairs_;
  std::array<Level, max_levels> levels_{};
  int count_ = 0;
};

}  // namespace incognita
