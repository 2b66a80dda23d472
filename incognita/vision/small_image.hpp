// A whole image at low resolution, for alignment: blurred, and normalized so that exposure does not matter.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

class StateArchive;

class SmallImage {
 public:
  static constexpr int max_width = 48;  ///< px

  /// Means over squares of pixels, blurred, with zero mean and unit variance (all zero for an image without contrast).
  void assign(const Image& image);
  bool empty() const { return width_ == 0; }
  int width() const { return width_; }
  int height() const { return height_; }
  float operator()(int u, int v) const { return values_[static_cast<std::size_t>(v) * width_ + u]; }

  /// Pixel of the image at the center of pixel (u, v) of this one, and back.
  Eigen::Vector2d to_image(double u, double v) const {
    return {(u + 0.5) * scale_ - 0.5, (v + 0.5) * scale_ - 0.5};
  }
  Eigen::Vector2d from_image(const Eigen::Vector2d& pixel) const {
    return ((pixel.array() + 0.5) / scale_ - 0.5).matrix();
  }
  /// Pixels of the image per pixel of this one.
  double scale() const { return scale_; }

  struct Sample {
    double value = 0;
    Eigen::RowVector2d gradient{0, 0};  ///< per pixel of this image
  };
  /// Interpolated linearly between pixel centers; nothing outside.
  std::optional<Sample> sample(const Eigen::Vector2d& at) const;

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  int width_ = 0, height_ = 0, scale_ = 1;
  std::vector<float> values_;
};

}  // namespace incognita
