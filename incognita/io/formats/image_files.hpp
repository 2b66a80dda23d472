// Image files and folders of them as a source of images.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "incognita/vision/image_source.hpp"

namespace incognita {

/// The given files, and the images of the given folders in natural order of their names. Names are the paths as given. Throws
/// InputError for a path that does not exist, and a folder without images.
std::unique_ptr<ImageSource> open_images(const std::vector<std::filesystem::path>& files_and_folders);

}  // namespace incognita
