// A gray image, 8 bits per pixel, rows from top to bottom.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace incognita {

class Image {
 public:
  Image() = default;
  Image(int width, int height, std::uint8_t value = 0)
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height + padding, value) {
    std::fill(pixels_.end() - padding, pixels_.end(), std::uint8_t{0});  // defined, for operator==
  }

  /// Readable bytes beyond the last pixel, for vector loads that overhang.
  static constexpr int padding = 16;

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  const std::uint8_t* row(int v) const { return pixels_.data() + static_cast<std::size_t>(v) * width_; }
  std::uint8_t* row(int v) { return pixels_.data() + static_cast<std::size_t>(v) * width_; }
  std::uint8_t operator()(int u, int v) const { return row(v)[u]; }
  std::uint8_t& operator()(int u, int v) { return row(v)[u]; }

  /// Bilinear interpolation between pixel centers. The point is clamped to the image, which must not be empty.
  double sample(double u, double v) const {
    u = std::clamp(u, 0.0, width_ - 1.0);
    v = std::clamp(v, 0.0, height_ - 1.0);
    const int iu = std::min(static_cast<int>(u), std::max(0, width_ - 2));
    const int iv = std::min(static_cast<int>(v), std::max(0, height_ - 2));
    const int right = width_ > 1 ? 1 : 0;
    const std::uint8_t* top = row(iv) + iu;
    const std::uint8_t* bottom = row(height_ > 1 ? iv + 1 : iv) + iu;
    const double a = u - iu, b = v - iv;
    return (1 - b) * ((1 - a) * top[0] + a * top[right]) + b * ((1 - a) * bottom[0] + a * bottom[right]);
  }

  bool operator==(const Image&) const = default;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace incognita
