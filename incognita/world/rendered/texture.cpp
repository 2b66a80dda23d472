#include "incognita/world/rendered/texture.hpp"

namespace incognita {
namespace {

/// Downsampled by two, each texel the mean of four; an odd last row or column is counted twice.
Image halved(const Image& fine) {
  Image coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  for (int v = 0; v < coarse.height(); ++v) {
    const std::uint8_t* top = fine.row(2 * v);
    const std::uint8_t* bottom = fine.row(std::min(2 * v + 1, fine.height() - 1));
    std::uint8_t* out = coarse.row(v);
    const int pairs = fine.width() / 2;
    for (int u = 0; u < pairs; ++u)
      out[u] = static_cast<std::uint8_t>(
          (top[2 * u] + top[2 * u + 1] + bottom[2 * u] + bottom[2 * u + 1] + 2) / 4);
    if (fine.width() % 2)
      out[pairs] = static_cast<std::uint8_t>((top[2 * pairs] + bottom[2 * pairs] + 1) / 2);
  }
  return coarse;
}

}  // namespace

Texture::Texture(const Image& finest) {
  if (finest.empty()) return;
  append(finest);
  Image level = finest;
  while (count_ < max_levels && (level.width() > 1 || level.height() > 1)) {
    level = halved(level);
    append(level);
  }
}

void Texture::append(const Image& image) {
  const int width = image.width(), height = image.height();
  levels_[count_++] = {pairs_.size(), width, height};
  pairs_.reserve(pairs_.size() + static_cast<std::size_t>(width + 1) * height);
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* texel = image.row(v);
    const std::uint8_t* below = image.row(std::min(v + 1, height - 1));
    for (int u = 0; u <= width; ++u) {
      const int column = std::min(u, width - 1);
      pairs_.push_back(static_cast<std::uint16_t>(texel[column] | below[column] << 8));
    }
  }
}

}  // namespace incognita
