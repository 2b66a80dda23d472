// The images of a recording by their number, wherever they are: files, a video, a bag.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita {

class IndexedImages {
 public:
  virtual ~IndexedImages() = default;
  /// Image number `frame` of the recording, from 0, gray. Throws std::runtime_error that names the file and what is wrong.
  /// Fast in increasing order; any order is allowed. Of one thread at a time.
  virtual std::shared_ptr<const Image> read(std::size_t frame) = 0;
};

/// One file per image.
std::shared_ptr<IndexedImages> image_files(std::vector<std::filesystem::path> files);

}  // namespace incognita
