#include "incognita/io/formats/gray_image.hpp"

#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace incognita {

Image gray_image(const cv::Mat& decoded) {
  cv::Mat gray = decoded;
  if (decoded.channels() == 3) cv::cvtColor(decoded, gray, cv::COLOR_BGR2GRAY);
  if (gray.type() != CV_8U) throw std::runtime_error("an image is not of 8 bits, gray or in color");
  Image image(gray.cols, gray.rows);
  for (int v = 0; v < gray.rows; ++v)
    std::memcpy(image.row(v), gray.ptr(v), static_cast<std::size_t>(gray.cols));
  return image;
}

}  // namespace incognita
