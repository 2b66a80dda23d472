#include "incognita/vision/small_image.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace incognita {

void SmallImage::assign(const Image& image) {
  scale_ = std::max(1, (image.width() + max_width - 1) / max_width);
  width_ = image.width() / scale_;
  height_ = image.height() / scale_;
  values_.resize(static_cast<std::size_t>(width_) * height_);
  if (values_.empty()) {
    width_ = height_ = 0;
    return;
  }
  const cv::Mat whole(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  cv::Mat gray, small(height_, width_, CV_32FC1, values_.data());
  cv::resize(whole(cv::Rect(0, 0, width_ * scale_, height_ * scale_)), gray, small.size(), 0, 0,
             cv::INTER_AREA);
  gray.convertTo(small, CV_32F);
  cv::GaussianBlur(small, small, {5, 5}, 1.0);
  cv::Scalar mean, sigma;
  cv::meanStdDev(small, mean, sigma);
  small = (small - mean[0]) * (sigma[0] > 0 ? 1 / sigma[0] : 0);
}

std::optional<SmallImage::Sample> SmallImage::sample(const Eigen::Vector2d& at) const {
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < width_ - 1 && at.y() < height_ - 1)) return std::nullopt;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  const double a = at.x() - u, b = at.y() - v;
  const double top_left = (*this)(u, v), top_right = (*this)(u + 1, v);
  const double bottom_left = (*this)(u, v + 1), bottom_right = (*this)(u + 1, v + 1);
  const double top = top_left + a * (top_right - top_left);
  const double bottom = bottom_left + a * (bottom_right - bottom_left);
  return Sample{top + b * (bottom - top),
                {(1 - b) * (top_right - top_left) + b * (bottom_right - bottom_left), bottom - top}};
}

}  // namespace incognita
