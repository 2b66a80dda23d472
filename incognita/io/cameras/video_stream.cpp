#include "incognita/io/cameras/video_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/gray_image.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/stream_times.hpp"

namespace incognita {
namespace {

constexpr double retry_s = 1, nap_s = 0.02;
constexpr int network_timeout_ms = 5000;

bool is_device(const std::string& source) { return source.starts_with("/dev/"); }
bool is_address(const std::string& source) { return source.find("://") != std::string::npos; }

std::string remedy(const std::string& source) {
  if (is_device(source))
    return "is it plugged in, used by no other program, and may you read it (group `video`)? `v4l2-ctl --list-devices` lists those there are";
  if (is_address(source)) return "does another player show it from this machine?";
  return "it is damaged, or of a kind that FFmpeg does not know";
}

std::string why_not_open(const std::string& source) {
  return fmt::format("{}: cannot be opened: {}", source, remedy(source));
}

}  // namespace

struct VideoStream::Capture {
  cv::VideoCapture video;
  StreamTimes times = {};
  bool is_file = false;

  bool open(const VideoStreamSettings& s) {
    try {
      if (is_device(s.source)) {
        video.open(s.source, cv::CAP_V4L2);
        video.set(cv::CAP_PROP_FRAME_WIDTH, s.width_px);
        video.set(cv::CAP_PROP_FRAME_HEIGHT, s.height_px);
        video.set(cv::CAP_PROP_FPS, s.rate_hz);
        video.set(cv::CAP_PROP_BUFFERSIZE, 1);
      } else {
        video.open(s.source, cv::CAP_FFMPEG,
                   {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, network_timeout_ms, cv::CAP_PROP_READ_TIMEOUT_MSEC,
                    network_timeout_ms});
        video.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
      }
    } catch (const cv::Exception&) {
      return false;
    }
    return video.isOpened();
  }
};

VideoStream::VideoStream(VideoStreamSettings settings)
    : settings_(std::move(settings)), capture_(std::make_unique<Capture>()) {
  capture_->is_file = !is_device(settings_.source) && !is_address(settings_.source);
  if (capture_->is_file && !file_exists(settings_.source))
    throw InputError(fmt::format("{}: there is no such video", settings_.source));
  if (!capture_->open(settings_)) throw InputError(why_not_open(settings_.source));
  thread_ = std::thread([this] { follow(); });
}

VideoStream::~VideoStream() {
  stop_ = true;
  thread_.join();
}

/// A camera that is gone, and a stream that is cut, are opened again as soon as that is possible.
void VideoStream::follow() {
  while (!stop_) {
    if (!fails() || stop_) break;
    if (!gone_.exchange(true))
      note(fmt::format("{}: gives no image any more; trying again", settings_.source));
    capture_->video.release();
    do wait_for(retry_s);
    while (!stop_ && !capture_->open(settings_));
    if (!stop_) note(fmt::format("{}: gives images again", settings_.source)), gone_ = false;
  }
  ended_ = capture_->is_file;
}

/// An image that cannot be used is the end of a stream, too.
bool VideoStream::fails() {
  try {
    return grab_until_it_fails();
  } catch (const std::exception& error) {  // also cv::Exception
    note(fmt::format("{}: {}", settings_.source, error.what()));
    return !capture_->is_file;
  }
}

/// False at the end of a file, which is played in its own time.
bool VideoStream::grab_until_it_fails() {
  Capture& c = *capture_;
  const double start_s = steady_s();
  while (!stop_) {
    if (!c.video.grab()) return !c.is_file;
    const double reported_s = c.video.get(cv::CAP_PROP_POS_MSEC) / 1000;
    const double t = c.times.time_of(reported_s, c.is_file ? start_s + reported_s : steady_s());
    if (c.is_file) wait_for(start_s + t - steady_s());
    cv::Mat decoded;
    if (!c.video.retrieve(decoded) || decoded.empty()) continue;
    images_.put({t, std::make_shared<const Image>(gray_image(decoded))});
  }
  return false;
}

void VideoStream::wait_for(double s) const {
  const double until_s = steady_s() + s;
  for (double left_s = s; left_s > 0 && !stop_; left_s = until_s - steady_s())
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, nap_s)));
}

void VideoStream::note(std::string event) {
  const std::lock_guard lock(mutex_);
  events_.push_back(std::move(event));
}

std::optional<LiveReading> VideoStream::read(double wait_s) { return images_.take(wait_s); }

std::string VideoStream::problem() const {
  return gone_ ? fmt::format("{}: gives no image any more: {}", settings_.source, remedy(settings_.source))
               : "";
}

std::vector<std::string> VideoStream::take_events() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

std::vector<std::pair<std::string, std::int64_t>> VideoStream::counts() const {
  return {{"camera_dropped_images", images_.dropped()}};
}

}  // namespace incognita
