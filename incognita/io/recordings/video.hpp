// Videos as recordings, decoded by OpenCV's videoio (FFmpeg).
#pragma once

#include <filesystem>

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// By the ending of the name: avi, mkv, mov, mp4, ...
bool looks_like_video(const std::filesystem::path& file);

/// Decodes the whole video once to learn the times of its images, which start at 0; they are those stored in the file, or
/// follow from its rate if it stores none, which is noted. A rotation stored in the file is ignored, as with image files.
/// Throws InputError naming the file and what to do if it cannot be decoded. What follows a damaged place is not used, which
/// is noted.
Recording read_video(const std::filesystem::path& file);

}  // namespace incognita
