#include "incognita/vision/patch.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
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

WarpedTexture::WarpedTexture(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view)
    : texture_(texture), texture_from_view_(texture_from_view) {
  if (!covers(1)) return;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
  principal.computeDirect(texture_from_view * texture_from_view.transpose());
  for (int axis = 0; axis < 2; ++axis)
    samples_[static_cast<std::size_t>(axis)] =
        along(principal.eigenvectors().col(axis), std::sqrt(std::max(0.0, principal.eigenvalues()[axis])));
}

// A texture pixel is already the mean over one pixel. The samples add to its variance, 1/12 px^2 per axis, what it lacks
// of that of a pixel of the view, length^2 / 12: equal samples over a width w have w^2 / 12 * (1 - 1 / count^2).
WarpedTexture::Samples WarpedTexture::along(const Eigen::Vector2d& axis, double length) {
  if (length <= 1) return {};
  const int count = static_cast<int>(std::ceil(length));
  const double width = std::sqrt((length * length - 1) / (1 - 1.0 / (count * count)));
  const Eigen::Vector2d step = width / count * axis;
  return {count, -(count - 1) / 2.0 * step, step};
}

bool WarpedTexture::covers(double half_px) const {
  constexpr double slack = 0.51;  // clamping by half a pixel at the texture's border is accepted
  const Eigen::Vector2d farthest = half_px * texture_from_view_.cwiseAbs().rowwise().sum();
  const Eigen::Vector2d last(texture_.pixels.width() - 1, texture_.pixels.height() - 1);
  // A comparison with nan is false
  return ((texture_.center - farthest).array() >= -slack).all() &&
         ((texture_.center + farthest - last).array() <= slack).all();
}

double WarpedTexture::at(const Eigen::Vector2d& off) const {
  const Eigen::Vector2d center = texture_.center + texture_from_view_ * off;
  const auto& [one, other] = samples_;
  double sum = 0;
  for (int i = 0; i < one.count; ++i)
    for (int k = 0; k < other.count; ++k) {
      const Eigen::Vector2d at = center + one.first + other.first + i * one.step + k * other.step;
      sum += texture_.pixels.sample(at.x(), at.y());
    }
  return sum / (one.count * other.count);
}

std::optional<PatchTemplate> warp(const PatchTexture& texture, const Eigen::Matrix2d& texture_from_view,
                                  int size) {
  const int half = size / 2;
  const WarpedTexture warped(texture, texture_from_view);
  if (!warped.covers(half)) return std::nullopt;
  std::array<double, max_patch_size * max_patch_size> gray;
  double sum = 0;
  int i = 0;
  for (int dv = -half; dv <= half; ++dv)
    for (int du = -half; du <= half; ++du) sum += gray[i++] = warped.at(Eigen::Vector2d(du, dv));
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
