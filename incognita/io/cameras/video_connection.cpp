#include "incognita/io/cameras/video_connection.hpp"

#include <utility>

#include "incognita/io/cameras/local_video.hpp"
#include "incognita/io/cameras/network_video.hpp"
#include "incognita/io/cameras/video_address.hpp"

namespace incognita {

std::unique_ptr<VideoConnection> open_video(const VideoStreamSettings& settings,
                                            std::shared_ptr<const std::atomic<bool>> stop) {
  if (is_device(settings.source)) return open_device(settings);
  if (is_address(settings.source)) return open_network(settings.source, std::move(stop));
  return open_file(settings.source);
}

}  // namespace incognita
