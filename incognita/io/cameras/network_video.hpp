// Streams of the network, by FFmpeg's libraries.
//
// OpenCV's videoio, which uses the same libraries, does for files. From the network it (4.6) gives an image of H.264 only after as many
// more as the machine has cores, which is half a second for 16 of them; does not say why nothing comes; and cannot be interrupted.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "incognita/io/cameras/video_connection.hpp"

namespace incognita {

/// Throws std::runtime_error with the reason and the remedy, after 5 s at the latest (the name of a host may take longer).
std::unique_ptr<VideoConnection> open_network(const std::string& address,
                                              std::shared_ptr<const std::atomic<bool>> stop);

}  // namespace incognita
