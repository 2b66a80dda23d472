#include "incognita/world/image_noise.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace incognita {
namespace {

constexpr int table_size = 1 << 17;

}  // namespace

ImageNoise::ImageNoise(double sigma_gray, std::uint64_t seed, const std::string& name) : random_(seed, name) {
  if (!(sigma_gray >= 0 && sigma_gray <= 100))
    throw std::invalid_argument("room.sigma_image_gray must be 0 to 100, got " + std::to_string(sigma_gray));
  if (sigma_gray == 0) return;
  table_.resize(table_size);
  for (std::int16_t& n : table_) n = static_cast<std::int16_t>(std::lround(sigma_gray * random_.normal()));
}

void ImageNoise::add_to(Image& image) {
  if (table_.empty()) return;
  const int width = image.width();
  for (int v = 0; v < image.height(); ++v) {
    std::uint8_t* pixel = image.row(v);
    for (int u = 0; u < width; u += table_size / 8) {  // a single run except for very wide images
      const int count = std::min(width - u, table_size / 8);
      const std::int16_t* noise = &table_[random_.below(table_size - count + 1)];
      for (int i = 0; i < count; ++i)
        pixel[u + i] = static_cast<std::uint8_t>(std::clamp(pixel[u + i] + noise[i], 0, 255));
    }
  }
}

}  // namespace incognita
