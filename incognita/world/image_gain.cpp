#include "incognita/world/image_gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace incognita {

void apply_gain(Image& image, double gain) {
  std::array<std::uint8_t, 256> scaled;
  for (int gray = 0; gray < 256; ++gray)
    scaled[gray] = static_cast<std::uint8_t>(std::lround(std::min(255.0, gain * gray)));
  for (int v = 0; v < image.height(); ++v) {
    std::uint8_t* pixel = image.row(v);
    for (int u = 0; u < image.width(); ++u) pixel[u] = scaled[pixel[u]];
  }
}

}  // namespace incognita
