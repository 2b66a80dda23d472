#include "incognita/vision/pyramid.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "incognita/vision/as_matrix.hpp"

namespace incognita {

void halve(const Image& image, Image& half) {
  const int width = (image.width() + 1) / 2, height = (image.height() + 1) / 2;
  if (half.width() != width || half.height() != height) half = Image(width, height);
  cv::Mat result = as_matrix(half);
  cv::pyrDown(as_matrix(image), result, result.size());
}

ImagePyramid::ImagePyramid(const ImagePyramid& other)
    : levels_(other.levels_), halves_(other.halves_), summed_(other.summed_) {
  for (std::size_t level = 1; level < summed_.size(); ++level) summed_[level].refer_to(halves_[level - 1]);
}

void ImagePyramid::assign(const Image& image, int most_levels) {
  summed_[0].assign(image);
  levels_ = 1;
  while (levels_ < std::min(most_levels, max_levels)) {
    const Image& finer = this->image(levels_ - 1);
    if (std::min(finer.width(), finer.height()) < 2 * min_side_px) break;
    Image& half = halves_[static_cast<std::size_t>(levels_ - 1)];
    halve(finer, half);
    summed_[static_cast<std::size_t>(levels_++)].assign(half);
  }
}

}  // namespace incognita
