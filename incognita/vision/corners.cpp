#include "incognita/vision/corners.hpp"

#include <opencv2/imgproc.hpp>

namespace incognita {

std::optional<Corner> strongest_corner(const Image& image, const PixelBox& box, int window_px) {
  const cv::Rect whole(0, 0, image.width(), image.height());
  const cv::Rect wanted = cv::Rect(box.u, box.v, box.width, box.height) & whole;
  if (wanted.empty()) return std::nullopt;
  // Gradients at the box's rim need pixels around it
  const int rim = window_px / 2 + 2;
  const cv::Rect around =
      cv::Rect(wanted.x - rim, wanted.y - rim, wanted.width + 2 * rim, wanted.height + 2 * rim) & whole;
  const cv::Mat pixels(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  cv::Mat strength;
  cv::cornerMinEigenVal(pixels(around).clone(), strength, window_px, 3);
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(strength(wanted - around.tl()), nullptr, &best, nullptr, &at);
  // OpenCV sums over the window with Sobel's gradient (8 times ours) divided by 4 * window * 255
  return Corner{at.x + wanted.x, at.y + wanted.y, best * 255.0 * 255.0 / 4.0};
}

}  // namespace incognita
