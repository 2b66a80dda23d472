#include "incognita/vision/patch.hpp"

#include <cmath>

namespace incognita {

std::optional<PatchTexture> cut_texture(const Image& image, const Eigen::Vector2d& center, int side,
                                        int core_px) {
  const int cu = static_cast<int>(std::lround(center.x())), cv = static_cast<int>(std::lround(center.y()));
  if (cu < core_px || cv < core_px || cu >= image.width() - core_px || cv >= image.height() - core_px)
    return std::nullopt;
  const int u0 = std::max(0, cu - side / 2), v0 = std::max(0, cv - side / 2);
  const int u1 = std::min(image.width(), cu + side / 2 + 1), v1 = std::min(image.height(), cv + side / 2 + 1);
  PatchTexture texture{Image(u1 - u0, v1 - v0), center - Eigen::Vector2d(u0, v0)};
  for (int v = v0; v < v1; ++v) std::copy(image.row(v) + u0, image.row(v) + u1, texture.pixels.row(v - v0));
  return texture;
}

std::optional<PatchTemplate> warp(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view,
                                  int size) {
  const int half = size / 2;
  std::array<double, max_patch_size * max_patch_size> gray;
  double sum = 0;
  int i = 0;
  for (int dv = -half; dv <= half; ++dv)
    for (int du = -half; du <= half; ++du) {
      const Eigen::Vector2d at = texture.center + texture_from_view * Eigen::Vector2d(du, dv);
      constexpr double slack = 0.51;  // clamping by half a pixel at the texture's border is accepted
      if (!(at.x() >= -slack && at.y() >= -slack && at.x() <= texture.pixels.width() - 1 + slack &&
            at.y() <= texture.pixels.height() - 1 + slack))
        return std::nullopt;
      sum += gray[i++] = texture.pixels.sample(at.x(), at.y());
    }
  PatchTemplate patch;
  patch.size = size;
  const double mean = sum / i;
  double squares = 0;
  patch.sum = 0;
  for (int k = 0; k < i; ++k) {
    const auto value = static_cast<std::int16_t>(std::lround(8 * (gray[k] - mean)));
    patch.values[k / size * PatchTemplate::row_stride + k % size] = value;
    squares += static_cast<double>(value) * value;
    patch.sum += value;
  }
  patch.norm = std::sqrt(squares - static_cast<double>(patch.sum) * patch.sum / i);
  if (patch.norm < 8.0 * size) return std::nullopt;  // less than one gray level of contrast
  return patch;
}

}  // namespace incognita
