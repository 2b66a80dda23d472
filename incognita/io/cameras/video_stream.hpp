// Cameras of this machine, streams of the network and videos in real time, by OpenCV's videoio, in a thread of its own.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "incognita/messages/newest.hpp"
#include "incognita/world/live/live_source.hpp"

namespace incognita {

struct VideoStreamSettings {
  std::string source;               ///< "/dev/video0", "rtsp://...", "http://...", or the file of a video
  int width_px = 0, height_px = 0;  ///< asked of a camera, which may give another size
  double rate_hz = 30;              ///< asked of a camera
};

/// The image is that at the moment when it is asked for; older ones are dropped and counted. Its time is that of the driver
/// or of the stream where they report one, else that of its arrival.
class VideoStream final : public LiveSource {
 public:
  /// Throws InputError that names the source and the remedy if it cannot be opened.
  explicit VideoStream(VideoStreamSettings settings);
  ~VideoStream() override;
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;

  std::optional<LiveReading> read(double wait_s) override;
  bool has_ended() const override { return ended_; }
  std::string problem() const override;
  std::vector<std::string> take_events() override;
  std::vector<std::pair<std::string, std::int64_t>> counts() const override;

 private:
  struct Capture;
  void follow();
  bool fails();
  bool grab_until_it_fails();
  void wait_for(double s) const;
  void note(std::string event);

  VideoStreamSettings settings_;
  std::unique_ptr<Capture> capture_;  ///< of the thread, once that runs
  Newest<LiveReading> images_;
  std::atomic<bool> stop_ = false, ended_ = false, gone_ = false;
  std::mutex mutex_;  ///< of events_
  std::vector<std::string> events_;
  std::thread thread_;
};

}  // namespace incognita
