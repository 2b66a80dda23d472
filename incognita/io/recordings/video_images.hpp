// Images of a video one after the other.
#pragma once

#include <filesystem>
#include <memory>

#include "incognita/vision/image_source.hpp"

namespace incognita {

/// At most `most` images, evenly spread over the video, and no more than take 512 MiB: 64 of 3840x2160 px. The video is decoded here,
/// once unless it announces a wrong number of images, and the images are kept in memory. Throws InputError and reports progress as
/// read_video() does.
std::unique_ptr<ImageSource> open_video_images(const std::filesystem::path& video, std::size_t most);

}  // namespace incognita
