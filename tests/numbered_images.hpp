// Images that carry a number, to see which of them arrived.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace incognita::testing {

/// JPEG, gray, whose left half carries a number from 0 to 24. Its noise makes it as large as those of a camera, of which FFmpeg
/// reads 2 kB before it knows what they are.
inline std::string numbered_jpeg(int number, int width = 64, int height = 48) {
  cv::Mat image(height, width, CV_8UC1);
  cv::randu(image, 0, 255);
  image.colRange(0, width / 2) = cv::Scalar(10.0 * number);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes);
  return {bytes.begin(), bytes.end()};
}

/// `value`: of a pixel of the left half.
inline int number_of(int value) { return (value + 5) / 10; }

}  // namespace incognita::testing
