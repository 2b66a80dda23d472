#include "incognita/vision/saved_images.hpp"

#include "incognita/vision/small_image.hpp"

namespace incognita {

void SmallImage::state(StateArchive& archive) {
  auto& [width, height, scale, values] = *this;
  archive(width, height, scale, values);
  const bool fits = width >= 0 && height >= 0 && width <= max_width && scale > 0 &&
                    values.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!fits) throw DamagedState("a small image of " + std::to_string(width) + "x" + std::to_string(height));
}

}  // namespace incognita
