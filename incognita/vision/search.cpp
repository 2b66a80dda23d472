#include "incognita/vision/search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace incognita {

namespace {

/// Contribution of a pixel to the sums: gray value in the upper 32 bits, its square in the lower 32.
constexpr auto both = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t gray = 0; gray < 256; ++gray) table[gray] = gray << 32 | gray * gray;
  return table;
}();

/// Squared deviations from the mean, summed over a square of the image centered at (u, v).
double variance_around(const SummedImage& image, int u, int v, int size) {
  const auto [sum, squares] = image.over(u - size / 2, v - size / 2, size);
  return squares - sum * sum / (size * size);
}

}  // namespace

void SummedImage::assign(const Image& image) {
  image_ = &image;
  stride_ = image.width() + 1;
  sums_.resize(static_cast<std::size_t>(stride_) * (image.height() + 1));
  std::fill_n(sums_.begin(), stride_, 0u);
  for (int v = 0; v < image.height(); ++v) {
    const std::uint8_t* row = image.row(v);
    const std::uint64_t* above = sums_.data() + static_cast<std::size_t>(v) * stride_ + 1;
    std::uint64_t* here = sums_.data() + static_cast<std::size_t>(v + 1) * stride_;
    std::uint64_t sum = 0;
    *here++ = 0;
    for (int u = 0; u < image.width(); ++u) here[u] = above[u] + (sum += both[row[u]]);
  }
}

SummedImage::Sums SummedImage::over(int u, int v, int size) const {
  const std::size_t a = static_cast<std::size_t>(v) * stride_ + u, b = a + size;
  const std::size_t c = a + static_cast<std::size_t>(size) * stride_, d = c + size;
  const std::uint64_t sums = sums_[d] - sums_[c] - sums_[b] + sums_[a];
  return {static_cast<double>(sums >> 32), static_cast<double>(sums & 0xffffffffu)};
}

void CorrelationSheet::start(const SummedImage& image, const PatchTemplate& patch, int u_min, int u_max,
                             int v_min, int v_max) {
  image_ = &image;
  patch_ = &patch;
  computed_ = 0;
  const int half = patch.size / 2;
  u_min_ = std::max(u_min, half);
  v_min_ = std::max(v_min, half);
  u_max_ = std::min(u_max, image.image().width() - 1 - half);
  v_max_ = std::min(v_max, image.image().height() - 1 - half);
  const int width = std::max(0, u_max_ - u_min_ + 1), height = std::max(0, v_max_ - v_min_ + 1);
  values_.assign(static_cast<std::size_t>(width) * height, -3.0f);
}

double CorrelationSheet::at(int u, int v) {
  if (!contains(u, v)) return -2;
  float& value = values_[static_cast<std::size_t>(v - v_min_) * (u_max_ - u_min_ + 1) + (u - u_min_)];
  if (value < -2) {
    value = static_cast<float>(correlate(u, v));
    ++computed_;
  }
  return value;
}

double CorrelationSheet::correlate(int u, int v) const {
  const int size = patch_->size, half = size / 2;
  const Image& image = image_->image();
  std::int32_t product = 0;
  for (int r = 0; r < size; ++r) {
    const std::uint8_t* pixels = image.row(v - half + r) + (u - half);
    const std::int16_t* values = patch_->values.data() + r * PatchTemplate::row_stride;
    for (int c = 0; c < PatchTemplate::row_stride; ++c)
      product += static_cast<std::int16_t>(pixels[c]) * values[c];
  }
  const auto [sum, squares] = image_->over(u - half, v - half, size);
  const double variance = squares - sum * sum / (size * size);  // times the number of pixels
  if (variance < 1.0 * size * size) return 0;  // below one gray level of contrast any patch would correlate
  return (product - patch_->sum * sum / (size * size)) / (patch_->norm * std::sqrt(variance));
}

// The quadratic is put through -contrast * (1 - correlation), which is, but for a factor, the negative squared difference after
// patch and image are scaled to the geometric mean of their contrasts. The correlation itself scales the image to unit contrast.
// Near the corner of a dark rectangle the contrast grows toward its inside, so that the correlation falls less there than
// outside, and a quadratic through it peaks 0.03 to 0.05 px inside the corner.
Eigen::Vector2d CorrelationSheet::refine(int u, int v) {
  const Eigen::Vector2d here(u, v);
  double c[3][3];
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du) {
      const double correlation = at(u + du, v + dv);
      if (correlation < -1.5) return here;  // at the border of the searched range
      c[dv + 1][du + 1] = -std::sqrt(std::max(0.0, variance_around(*image_, u + du, v + dv, patch_->size))) *
                          (1 - correlation);
    }
  // Quadratic through the center, with central differences as derivatives; its maximum, if there is one
  const Eigen::Vector2d slope((c[1][2] - c[1][0]) / 2, (c[2][1] - c[0][1]) / 2);
  const double cross = (c[2][2] - c[2][0] - c[0][2] + c[0][0]) / 4;
  Eigen::Matrix2d curvature;
  curvature << c[1][2] - 2 * c[1][1] + c[1][0], cross, cross, c[2][1] - 2 * c[1][1] + c[0][1];
  if (!(curvature(0, 0) < -1e-9 && curvature.determinant() > 1e-12)) return here;
  const Eigen::Vector2d offset = -curvature.inverse() * slope;
  return here + offset.cwiseMax(-0.5).cwiseMin(0.5);
}

namespace {

struct Extent {
  int u_min, u_max, v_min, v_max;
};

Extent extent(const Ellipse& ellipse, double max_half_axis_px) {
  const double du = std::min(max_half_axis_px, ellipse.gate_sigmas * std::sqrt(ellipse.covariance(0, 0)));
  const double dv = std::min(max_half_axis_px, ellipse.gate_sigmas * std::sqrt(ellipse.covariance(1, 1)));
  return {static_cast<int>(std::ceil(ellipse.center.x() - du)),
          static_cast<int>(std::floor(ellipse.center.x() + du)),
          static_cast<int>(std::ceil(ellipse.center.y() - dv)),
          static_cast<int>(std::floor(ellipse.center.y() + dv))};
}

}  // namespace

Ellipse with_nearest_pixels(const Ellipse& gate) {
  const double half_diagonal = std::numbers::sqrt2 / 2 / gate.gate_sigmas;  // px per sigma of the gate
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(gate.covariance);
  const Eigen::Array2d sigmas = axes.eigenvalues().array().max(0).sqrt();
  const Eigen::Array2d widened = sigmas.max((sigmas + half_diagonal).min(2 * half_diagonal));
  const Eigen::Matrix2d& directions = axes.eigenvectors();
  return {gate.center, directions * widened.square().matrix().asDiagonal() * directions.transpose(),
          gate.gate_sigmas};
}

std::optional<Found> search(CorrelationSheet& sheet, const Ellipse& ellipse, double max_half_axis_px) {
  const Extent box = extent(ellipse, max_half_axis_px);
  const Eigen::Matrix2d inverse = ellipse.covariance.inverse();
  const double gate = ellipse.gate_sigmas * ellipse.gate_sigmas;
  int best_u = 0, best_v = 0;
  double best = -2;
  for (int v = box.v_min; v <= box.v_max; ++v)
    for (int u = box.u_min; u <= box.u_max; ++u) {
      const Eigen::Vector2d d(u - ellipse.center.x(), v - ellipse.center.y());
      if (d.dot(inverse * d) > gate) continue;
      const double here = sheet.at(u, v);
      if (here > best) {
        best = here;
        best_u = u;
        best_v = v;
      }
    }
  if (best < -1.5) return std::nullopt;
  return Found{sheet.refine(best_u, best_v), best};
}

std::optional<Found> search(CorrelationSheet& sheet, const SummedImage& image, const PatchTemplate& patch,
                            const Ellipse& ellipse, double max_half_axis_px) {
  const Extent box = extent(ellipse, max_half_axis_px);
  // One more pixel on each side, so that a peak at the border can be refined
  sheet.start(image, patch, box.u_min - 1, box.u_max + 1, box.v_min - 1, box.v_max + 1);
  return search(sheet, ellipse, max_half_axis_px);
}

}  // namespace incognita
