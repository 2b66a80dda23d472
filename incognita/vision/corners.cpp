#include "incognita/vision/corners.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "incognita/vision/as_matrix.hpp"

namespace incognita {
namespace {

/// OpenCV sums over the window with a Sobel gradient (8 times the unit gradient) divided by 4 * window * 255
constexpr double gray_per_opencv = 255.0 * 255.0 / 4.0;

}  // namespace

void CornerMap::assign(const Image& image, int window_px) {
  width_ = image.width();
  height_ = image.height();
  strengths_.resize(static_cast<std::size_t>(width_) * height_);
  cv::Mat strength(height_, width_, CV_32FC1, strengths_.data());
  cv::cornerMinEigenVal(as_matrix(image), strength, window_px, 3);
}

std::optional<Corner> CornerMap::strongest(const PixelBox& box) const {
  const cv::Mat strength(height_, width_, CV_32FC1, const_cast<float*>(strengths_.data()));
  const cv::Rect wanted = cv::Rect(box.u, box.v, box.width, box.height) & cv::Rect(0, 0, width_, height_);
  if (wanted.empty()) return std::nullopt;
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(strength(wanted), nullptr, &best, nullptr, &at);
  return Corner{at.x + wanted.x, at.y + wanted.y, best * gray_per_opencv};
}

std::optional<Corner> strongest_corner(const Image& image, const PixelBox& box, int window_px) {
  const cv::Rect whole(0, 0, image.width(), image.height());
  const cv::Rect wanted = cv::Rect(box.u, box.v, box.width, box.height) & whole;
  if (wanted.empty()) return std::nullopt;
  // Gradients at the border of the box need the pixels around it
  const int rim = window_px / 2 + 2;
  const cv::Rect around =
      cv::Rect(wanted.x - rim, wanted.y - rim, wanted.width + 2 * rim, wanted.height + 2 * rim) & whole;
  cv::Mat strength;
  cv::cornerMinEigenVal(as_matrix(image)(around).clone(), strength, window_px, 3);
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(strength(wanted - around.tl()), nullptr, &best, nullptr, &at);
  return Corner{at.x + wanted.x, at.y + wanted.y, best * gray_per_opencv};
}

std::vector<Corner> strong_corners(const Image& image, int window_px, double min_strength, int apart_px,
                                   int margin_px, int max_count) {
  cv::Mat strength, highest;
  cv::cornerMinEigenVal(as_matrix(image), strength, window_px, 3);
  const int side = 2 * apart_px + 1;
  cv::dilate(strength, highest, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  const auto least = static_cast<float>(min_strength / gray_per_opencv);
  std::vector<Corner> corners;
  for (int v = margin_px; v < image.height() - margin_px; ++v) {
    const float* here = strength.ptr<float>(v);
    const float* most = highest.ptr<float>(v);
    for (int u = margin_px; u < image.width() - margin_px; ++u)
      if (here[u] >= least && here[u] == most[u]) corners.push_back({u, v, here[u] * gray_per_opencv});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.strength > b.strength; });
  if (corners.size() > static_cast<std::size_t>(max_count))
    corners.resize(static_cast<std::size_t>(max_count));
  return corners;
}

std::optional<Eigen::Vector2d> center_of_corner(const Image& image, const Eigen::Vector2d& near,
                                                int window_px, int left_out_px) {
  const int half = window_px / 2;
  const cv::Point2f start(static_cast<float>(near.x()), static_cast<float>(near.y()));
  std::vector<cv::Point2f> at{start};
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.01);
  const int dead = left_out_px > 0 ? left_out_px / 2 : -1;
  cv::cornerSubPix(as_matrix(image), at, {half, half}, {dead, dead}, until);
  // OpenCV returns the start point when the iteration diverges
  if (at[0] == start) return std::nullopt;
  return Eigen::Vector2d(at[0].x, at[0].y);
}

}  // namespace incognita
