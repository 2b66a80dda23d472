#include "incognita/vision/descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace incognita {
namespace {

constexpr int cells = 4, directions = 8;
constexpr int side = 16;                         // samples of the gradient across the square
constexpr double step_px = described_px / side;  // between samples
constexpr int grid = side + 2;                   // samples of the gray value: one more on each side
constexpr int orientation_bins = 36;
constexpr double least_share = 0.8;               // of a dominant orientation, relative to the strongest
constexpr double orientation_sigma = side / 5.0;  // of the weight of a gradient, samples from the center
constexpr double descriptor_sigma = side / 2.0;
constexpr double length = 512, clipped = 0.2;  // of a descriptor; of its largest entries
constexpr float two_pi = 2 * std::numbers::pi_v<float>;

/// Within 2e-4 rad of std::atan2, in [0, 2 pi).
float fast_angle(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float most = std::max(ax, ay);
  if (most == 0) return 0;
  const float t = std::min(ax, ay) / most, s = t * t;
  float angle =
      t * (0.99997726f +
           s * (-0.33262347f + s * (0.19354346f + s * (-0.11643287f + s * (0.05265332f - s * 0.01172120f)))));
  if (ay > ax) angle = std::numbers::pi_v<float> / 2 - angle;
  if (x < 0) angle = std::numbers::pi_v<float> - angle;
  if (y < 0) angle = two_pi - angle;
  return angle >= two_pi ? 0 : angle;
}

struct Gradient {
  float magnitude, angle;  ///< gray levels per sample; in the axes of the grid
};
using Gradients = std::array<Gradient, side * side>;

/// Gradients on a grid that is rotated by `turn_rad` in the image.
Gradients gradients_around(const Image& image, const Eigen::Vector2d& center, double turn_rad) {
  std::array<float, grid * grid> gray;
  const double c = step_px * std::cos(turn_rad), s = step_px * std::sin(turn_rad);
  constexpr double middle = (grid - 1) / 2.0;
  for (int row = 0; row < grid; ++row)
    for (int column = 0; column < grid; ++column) {
      const double x = column - middle, y = row - middle;
      gray[static_cast<std::size_t>(row * grid + column)] =
          static_cast<float>(image.sample(center.x() + c * x - s * y, center.y() + s * x + c * y));
    }
  Gradients out;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const float* at = &gray[static_cast<std::size_t>((row + 1) * grid + column + 1)];
      const float dx = at[1] - at[-1], dy = at[grid] - at[-grid];
      out[static_cast<std::size_t>(row * side + column)] = {std::sqrt(dx * dx + dy * dy), fast_angle(dy, dx)};
    }
  return out;
}

/// Weights of the samples by their distance from the center.
std::array<float, side * side> weights(double sigma) {
  std::array<float, side * side> out;
  constexpr double middle = (side - 1) / 2.0;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      out[static_cast<std::size_t>(row * side + column)] = static_cast<float>(std::exp(
          -((row - middle) * (row - middle) + (column - middle) * (column - middle)) / (2 * sigma * sigma)));
  return out;
}

using OrientationHistogram = std::array<float, orientation_bins>;

OrientationHistogram smoothed(const OrientationHistogram& h) {
  OrientationHistogram out;
  for (int i = 0; i < orientation_bins; ++i)
    out[static_cast<std::size_t>(i)] =
        (h[static_cast<std::size_t>((i + orientation_bins - 1) % orientation_bins)] +
         h[static_cast<std::size_t>(i)] * 2 + h[static_cast<std::size_t>((i + 1) % orientation_bins)]) /
        4;
  return out;
}

struct Orientation {
  double angle_rad;
  float weight;
};

/// Peaks of the histogram of gradient directions, the strongest first.
std::vector<Orientation> dominant_orientations(const Gradients& gradients) {
  static const auto weight = weights(orientation_sigma);
  OrientationHistogram h{};
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    const int bin = static_cast<int>(gradients[i].angle * (orientation_bins / two_pi));
    h[static_cast<std::size_t>(std::min(bin, orientation_bins - 1))] += weight[i] * gradients[i].magnitude;
  }
  h = smoothed(smoothed(h));
  const float most = *std::max_element(h.begin(), h.end());
  std::vector<Orientation> peaks;
  for (int i = 0; most > 1 && i < orientation_bins; ++i) {
    const float before = h[static_cast<std::size_t>((i + orientation_bins - 1) % orientation_bins)],
                here = h[static_cast<std::size_t>(i)],
                after = h[static_cast<std::size_t>((i + 1) % orientation_bins)];
    if (here < least_share * most || here < before || here <= after) continue;
    const double offset = 0.5 * (before - after) / (before - 2 * here + after);
    peaks.push_back({(i + 0.5 + offset) * (2 * std::numbers::pi / orientation_bins), here});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Orientation& a, const Orientation& b) { return a.weight > b.weight; });
  return peaks;
}

/// Adds a gradient to the four nearest cells and two nearest directions.
void add(const Gradient& gradient, float weight, int row, int column, std::array<float, descriptor_size>& h) {
  constexpr float per_cell = static_cast<float>(cells) / side;
  const float r = (static_cast<float>(row) + 0.5f) * per_cell - 0.5f,
              c = (static_cast<float>(column) + 0.5f) * per_cell - 0.5f;
  const float d = gradient.angle * (directions / two_pi);
  const int r0 = static_cast<int>(std::floor(r)), c0 = static_cast<int>(std::floor(c)),
            d0 = static_cast<int>(d);
  const float fr = r - static_cast<float>(r0), fc = c - static_cast<float>(c0),
              fd = d - static_cast<float>(d0);
  const float value = weight * gradient.magnitude;
  for (int i = 0; i < 2; ++i) {
    if (r0 + i < 0 || r0 + i >= cells) continue;
    for (int j = 0; j < 2; ++j) {
      if (c0 + j < 0 || c0 + j >= cells) continue;
      float* cell = &h[static_cast<std::size_t>(((r0 + i) * cells + c0 + j) * directions)];
      const float share = value * (i == 0 ? 1 - fr : fr) * (j == 0 ? 1 - fc : fc);
      cell[d0 % directions] += share * (1 - fd);
      cell[(d0 + 1) % directions] += share * fd;
    }
  }
}

float norm_of(const std::array<float, descriptor_size>& h) {
  float sum = 0;
  for (const float value : h) sum += value * value;
  return std::sqrt(sum);
}

Descriptor descriptor_of(const Gradients& gradients, double angle_rad) {
  static const auto weight = weights(descriptor_sigma);
  std::array<float, descriptor_size> h{};
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const auto i = static_cast<std::size_t>(row * side + column);
      add(gradients[i], weight[i], row, column, h);
    }
  const float most = static_cast<float>(clipped) * norm_of(h);
  for (float& value : h) value = std::min(value, most);
  const float scale = static_cast<float>(length) / std::max(norm_of(h), 1e-6f);
  Descriptor out;
  out.angle_rad = angle_rad;
  for (std::size_t i = 0; i < h.size(); ++i)
    out.bins[i] = static_cast<std::uint8_t>(std::min(255.0f, h[i] * scale + 0.5f));
  return out;
}

}  // namespace

void describe(const Image& image, const Eigen::Vector2d& pixel, int max_orientations,
              std::vector<Descriptor>& out) {
  const std::vector<Orientation> orientations = dominant_orientations(gradients_around(image, pixel, 0));
  const auto count = std::min(orientations.size(), static_cast<std::size_t>(max_orientations));
  for (std::size_t k = 0; k < count; ++k) {
    const double angle_rad = orientations[k].angle_rad;
    out.push_back(descriptor_of(gradients_around(image, pixel, angle_rad), angle_rad));
  }
}

int squared_distance(const Descriptor& a, const Descriptor& b, int limit) {
  constexpr std::size_t part = 32;  // most pairs are unrelated, and beyond the limit before the last part
  int sum = 0;
  for (std::size_t first = 0; first < descriptor_size && sum <= limit; first += part)
    for (std::size_t i = first; i < first + part; ++i) {
      const int difference = static_cast<int>(a.bins[i]) - static_cast<int>(b.bins[i]);
      sum += difference * difference;
    }
  return sum;
}

}  // namespace incognita
