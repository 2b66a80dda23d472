// Images one after the other, wherever they come from: files, a video, a camera.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "incognita/vision/image.hpp"

namespace incognita {

struct SourceImage {
  std::string name;
  Image image;
  std::string failure;  ///< why it could not be read; the image is then empty
};

class ImageSource {
 public:
  virtual ~ImageSource() = default;
  /// Nothing after the last image.
  virtual std::optional<SourceImage> next() = 0;
  /// Passes over an image without reading it.
  virtual void skip() = 0;
  /// The first image is the next one again.
  virtual void rewind() = 0;
  /// Number of images; 0 if it is not known.
  virtual std::size_t count() const = 0;
};

}  // namespace incognita
