// Images of OpenCV as those of this program.
#pragma once

#include "incognita/vision/image.hpp"

namespace cv {
class Mat;
}

namespace incognita {

/// Of 8 bits, gray or in color (BGR). Throws std::runtime_error for any other.
Image gray_image(const cv::Mat& decoded);

}  // namespace incognita
