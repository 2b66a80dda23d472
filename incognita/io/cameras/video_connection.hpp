// One connection to a camera, stream or video, from its opening until it fails. Of one thread.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "incognita/vision/image.hpp"

namespace incognita {

struct VideoStreamSettings {
  std::string source;               ///< "/dev/video0", "rtsp://...", "http://...", or the file of a video
  int width_px = 0, height_px = 0;  ///< asked of a camera, which may give another size
  double rate_hz = 30;              ///< asked of a camera
};

class VideoConnection {
 public:
  virtual ~VideoConnection() = default;
  /// Waits for the next image. False at the end of a video. Throws std::runtime_error with the reason once none can come any
  /// more, and soon after `stop`.
  virtual bool grab() = 0;
  /// s, of the image that was grabbed, on the clock of the source; 0 where that reports none.
  virtual double reported_s() const = 0;
  /// The image that was grabbed; nothing if it is damaged. Throws std::runtime_error for a kind that is not known.
  virtual std::optional<Image> image() = 0;
  /// Whether it is a video of a known length, which has an end and is shown in its own time.
  virtual bool is_recorded() const = 0;
};

/// Throws std::runtime_error with the reason and the remedy, without the source. `stop` ends what waits for the network.
std::unique_ptr<VideoConnection> open_video(const VideoStreamSettings& settings,
                                            std::shared_ptr<const std::atomic<bool>> stop);

}  // namespace incognita
