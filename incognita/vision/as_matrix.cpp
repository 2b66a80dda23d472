#include "incognita/vision/as_matrix.hpp"

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace incognita {

cv::Mat as_matrix(const Image& image) {
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0))};
}

}  // namespace incognita
