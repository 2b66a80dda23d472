// Images as matrices of OpenCV, for the sources of this folder only.
#pragma once

#include "incognita/vision/image.hpp"

namespace cv {
class Mat;
}

namespace incognita {

/// Shares the pixels. OpenCV has no matrices of constants: those of a constant image must not be written.
cv::Mat as_matrix(const Image& image);

}  // namespace incognita
