// Images of a video one after the other.
#pragma once

#include <filesystem>
#include <memory>

#include "incognita/vision/image_source.hpp"

namespace incognita {

/// At most `most` images, evenly spread over the video. Throws InputError as read_video() does.
std::unique_ptr<ImageSource> open_video_images(const std::filesystem::path& video, std::size_t most);

}  // namespace incognita
