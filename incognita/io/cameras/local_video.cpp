#include "incognita/io/cameras/local_video.hpp"

#include <unistd.h>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <utility>

#include "incognita/io/formats/gray_image.hpp"

namespace incognita {
namespace {

class LocalVideo final : public VideoConnection {
 public:
  LocalVideo(cv::VideoCapture video, bool is_file) : video_(std::move(video)), is_file_(is_file) {}

  bool grab() override {
    if (video_.grab()) return true;
    if (is_file_) return false;
    throw std::runtime_error("it does not answer; is it still plugged in?");
  }
  double reported_s() const override { return video_.get(cv::CAP_PROP_POS_MSEC) / 1000; }
  std::optional<Image> image() override {
    cv::Mat decoded;
    if (!video_.retrieve(decoded) || decoded.empty()) return std::nullopt;
    return gray_image(decoded);
  }
  bool is_recorded() const override { return is_file_; }

 private:
  cv::VideoCapture video_;
  bool is_file_;
};

std::string why_no_device(const std::string& device) {
  if (access(device.c_str(), F_OK) != 0)
    return "there is no such device; is it plugged in? `v4l2-ctl --list-devices` (package v4l-utils) lists the cameras";
  if (access(device.c_str(), R_OK | W_OK) != 0)
    return "you may not use it; `sudo usermod -aG video $USER`, and log in again: then you are in the group `video`";
  return "it is used by another program, or it is no camera (many have two devices, and one of them gives no images): "
         "`fuser -v " +
         device + "` names the program, `v4l2-ctl --list-devices` the cameras";
}

/// By USB a camera sends large images at full rate only as JPEG. Where they fit, they are better without its traces.
void ask_for_jpeg_if_slow(cv::VideoCapture& video, double rate_hz) {
  constexpr double nearly = 0.9;
  const double given_hz = video.get(cv::CAP_PROP_FPS);
  if (!(given_hz > 0 && given_hz < nearly * rate_hz)) return;
  const double uncompressed = video.get(cv::CAP_PROP_FOURCC);
  video.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
  video.set(cv::CAP_PROP_FPS, rate_hz);
  if (!(video.get(cv::CAP_PROP_FPS) > given_hz)) video.set(cv::CAP_PROP_FOURCC, uncompressed);
}

}  // namespace

/// The driver's buffers are left as they are (4): with one alone, a camera by USB has nowhere to put the next image while this one
/// is read, and gives every second one. They hold nothing back, since a thread empties them.
std::unique_ptr<VideoConnection> open_device(const VideoStreamSettings& settings) {
  cv::VideoCapture video;
  try {
    video.open(settings.source, cv::CAP_V4L2);
    if (!video.isOpened()) throw std::runtime_error(why_no_device(settings.source));
    video.set(cv::CAP_PROP_FRAME_WIDTH, settings.width_px);
    video.set(cv::CAP_PROP_FRAME_HEIGHT, settings.height_px);
    video.set(cv::CAP_PROP_FPS, settings.rate_hz);
    ask_for_jpeg_if_slow(video, settings.rate_hz);
  } catch (const cv::Exception&) {
    throw std::runtime_error(why_no_device(settings.source));
  }
  return std::make_unique<LocalVideo>(std::move(video), false);
}

std::unique_ptr<VideoConnection> open_file(const std::string& file) {
  cv::VideoCapture video;
  try {
    video.open(file, cv::CAP_FFMPEG);
    video.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // the calibration belongs to the sensor
  } catch (const cv::Exception&) {
    // reported below
  }
  if (!video.isOpened()) throw std::runtime_error("it is damaged, or of a kind that FFmpeg does not know");
  return std::make_unique<LocalVideo>(std::move(video), true);
}

}  // namespace incognita
