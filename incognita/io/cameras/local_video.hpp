// Cameras of this machine and files, by OpenCV's videoio.
#pragma once

#include <memory>

#include "incognita/io/cameras/video_connection.hpp"

namespace incognita {

/// By Video4Linux. Throws std::runtime_error with the reason and the remedy.
std::unique_ptr<VideoConnection> open_device(const VideoStreamSettings& settings);
/// By FFmpeg. Throws std::runtime_error with the reason.
std::unique_ptr<VideoConnection> open_file(const std::string& file);

}  // namespace incognita
