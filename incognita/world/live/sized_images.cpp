#include "incognita/world/live/sized_images.hpp"

#include <stdexcept>

namespace incognita {
namespace {

std::string size_of(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

std::optional<LiveReading> SizedImages::read(double wait_s) {
  auto reading = source_->read(wait_s);
  if (!reading) return reading;
  const Image& image = *reading->image;
  if (image.width() == width_px_ && image.height() == height_px_) return reading;
  throw std::runtime_error("the camera gives images of " + size_of(image.width(), image.height()) +
                           " px, and camera.width_px and camera.height_px expect " +
                           size_of(width_px_, height_px_) + "; set the calibration for that size");
}

}  // namespace incognita
