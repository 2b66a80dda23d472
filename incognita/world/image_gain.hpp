// Brightness of an image: another light, another exposure.
#pragma once

#include "incognita/vision/image.hpp"

namespace incognita {

/// Multiplies every gray level by `gain`, not negative; clips at 255.
void apply_gain(Image& image, double gain);

}  // namespace incognita
