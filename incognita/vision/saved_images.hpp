// Images and patches in the state of a run.
#pragma once

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/vision/descriptor.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

/// Width and height, and the pixels; an empty image is one of 0 x 0.
inline void save(StateWriter& archive, const Image& image) {
  archive(image.width(), image.height());
  if (!image.empty()) archive.write(image.row(0), static_cast<std::size_t>(image.width()) * image.height());
}
inline void load(StateReader& archive, Image& image) {
  int width = 0, height = 0;
  archive(width, height);
  if (width < 0 || height < 0) throw DamagedState("an image of negative size");
  archive.need(static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height), 1);
  image = width > 0 && height > 0 ? Image(width, height) : Image();
  if (!image.empty()) archive.read(image.row(0), static_cast<std::size_t>(width) * height);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, PatchTexture& texture) {
  auto& [pixels, center] = texture;
  archive(pixels, center);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, Descriptor& descriptor) {
  auto& [bins, angle_rad] = descriptor;
  archive(bins, angle_rad);
}

}  // namespace incognita
