// Videos as recordings, decoded by OpenCV's videoio (FFmpeg).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "incognita/io/recordings/recording.hpp"

namespace incognita {

/// By the ending of the name: avi, mkv, mov, mp4, ...
bool looks_like_video(const std::filesystem::path& file);

/// An image of a video while the video is read.
struct PassingImage {
  std::size_t number = 0;     ///< from 0
  std::size_t announced = 0;  ///< number of images by the header of the file, which may be wrong; 0: unknown
  std::function<Image()>
      decode;  ///< Gray. Throws std::runtime_error naming the file. Not to be called later.
};

/// Decodes the whole video once to learn the times of its images, which start at 0; they are those stored in the file, or
/// follow from its rate if it stores none, which is noted. A rotation stored in the file is ignored, as with image files.
/// Throws InputError naming the file and what to do if it cannot be decoded. What follows a damaged place is not used, which
/// is noted. `visit` receives each image as it passes, also one that is not used then. Progress is reported: ReadingListener.
Recording read_video(const std::filesystem::path& file,
                     const std::function<void(const PassingImage&)>& visit = {});

}  // namespace incognita
