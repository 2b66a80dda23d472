// Cameras of this machine, streams of the network and videos in real time, in a thread of its own.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "incognita/io/cameras/video_connection.hpp"
#include "incognita/world/live/live_source.hpp"

namespace incognita {

/// The image is that at the moment when it is asked for; older ones are dropped and counted. Its time is that of the driver
/// or of the stream where they report one, else that of its arrival. A camera that is gone, and a stream that is cut, are opened
/// again as soon as that is possible; a video of known length ends.
class VideoStream final : public LiveSource {
 public:
  /// Throws InputError that names the source, the reason and the remedy if it cannot be opened.
  explicit VideoStream(VideoStreamSettings settings);
  /// Does not wait for a camera or a network that does not answer.
  ~VideoStream() override;
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;

  std::optional<LiveReading> read(double wait_s) override;
  bool has_ended() const override;
  std::string problem() const override;
  std::vector<std::string> take_events() override;
  std::vector<std::pair<std::string, std::int64_t>> counts() const override;

 private:
  class Follower;
  std::shared_ptr<Follower> follower_;  ///< of the thread, too, which may outlive this object
};

}  // namespace incognita
