#include "incognita/io/cameras/video_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "incognita/io/cameras/video_address.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/newest.hpp"
#include "incognita/messages/stream_times.hpp"

namespace incognita {

/// Takes the images of one source in a thread, and connects again where that breaks.
class VideoStream::Follower {
 public:
  explicit Follower(VideoStreamSettings settings)
      : settings_(std::move(settings)),
        name_(without_password(settings_.source)),
        connection_(open_video(settings_, stop_)) {}

  void follow() {
    while (fails()) connect_again();
    ended_ = !*stop_;
    connection_.reset();
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    over_.notify_all();
  }

  /// Waits for the thread, but not for a driver or a network that does not return.
  void end() {
    constexpr std::chrono::milliseconds most(300);
    *stop_ = true;
    std::unique_lock lock(mutex_);
    over_.wait_for(lock, most, [this] { return is_over_; });
  }

  std::optional<LiveReading> read(double wait_s) { return images_.take(wait_s); }
  bool has_ended() const { return ended_; }
  std::string problem() const {
    constexpr double stall_s = 1;
    const std::lock_guard lock(mutex_);
    if (!problem_.empty()) return fmt::format("{}: {}", name_, problem_);
    if (ended_ || steady_s() - last_image_s_ < stall_s) return "";
    return fmt::format("{}: is connected, and gives no image", name_);
  }
  std::vector<std::string> take_events() {
    const std::lock_guard lock(mutex_);
    return std::exchange(events_, {});
  }
  std::vector<std::pair<std::string, std::int64_t>> counts() const {
    return {{"camera_dropped_images", images_.dropped()},
            {"camera_damaged_images", damaged_},
            {"camera_connections", connections_}};
  }

 private:
  /// False at the end of a video. An image that cannot be used is a failure, too.
  bool fails() {
    try {
      grab_all();
      return false;
    } catch (const std::exception& error) {  // also cv::Exception
      if (*stop_) return false;
      set_problem(error.what());
      if (connection_->is_recorded()) {
        note(fmt::format("{}: ends before its end: {}", name_, error.what()));
        return false;
      }
      if (!std::exchange(is_gone_, true))
        note(fmt::format("{}: gives no image any more: {}; trying again", name_, error.what()));
      return true;
    }
  }

  void grab_all() {
    constexpr double longest_pause_s = 5;  // more is a jump in the times of the video
    double start_s = steady_s();
    std::optional<double> first_s;
    times_.start_anew();
    while (!*stop_ && connection_->grab()) {
      const double arrived_s = steady_s();
      std::optional<Image> image = connection_->image();
      if (!image) {
        ++damaged_;
        continue;
      }
      const double reported_s = connection_->reported_s();
      if (!first_s) first_s = reported_s;
      double shown_s = start_s + reported_s - *first_s;  // of a video
      if (const double pause_s = shown_s - arrived_s; pause_s > longest_pause_s)
        start_s -= pause_s, shown_s = arrived_s;
      const double t = times_.time_of(reported_s, connection_->is_recorded() ? shown_s : arrived_s);
      if (connection_->is_recorded()) wait_for(shown_s - steady_s());
      put({t, std::make_shared<const Image>(*std::move(image))});
    }
  }

  void put(LiveReading reading) {
    if (std::exchange(is_gone_, false)) {
      note(fmt::format("{}: gives images again", name_));
      set_problem("");
    }
    last_image_s_ = steady_s();
    images_.put(std::move(reading));
  }

  void connect_again() {
    constexpr double retry_s = 1;
    connection_.reset();
    while (!connection_ && !*stop_) {
      wait_for(retry_s);
      try {
        if (!*stop_) connection_ = open_video(settings_, stop_), ++connections_;
      } catch (const std::exception& error) {
        set_problem(error.what());
      }
    }
  }

  void wait_for(double s) const {
    constexpr double nap_s = 0.02;
    const double until_s = steady_s() + s;
    for (double left_s = s; left_s > 0 && !*stop_; left_s = until_s - steady_s())
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, nap_s)));
  }

  void set_problem(const std::string& problem) {
    const std::lock_guard lock(mutex_);
    problem_ = problem;
  }

  void note(std::string event) {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
  }

  const VideoStreamSettings settings_;
  const std::string name_;
  const std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
  std::unique_ptr<VideoConnection> connection_;  ///< of the thread, like the next two
  StreamTimes times_;
  bool is_gone_ = false;
  Newest<LiveReading> images_;
  std::atomic<bool> ended_ = false;
  std::atomic<double> last_image_s_ = steady_s();
  std::atomic<std::int64_t> damaged_ = 0, connections_ = 1;
  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable over_;
  bool is_over_ = false;
  std::string problem_;
  std::vector<std::string> events_;
};

VideoStream::VideoStream(VideoStreamSettings settings) {
  const std::string& source = settings.source;
  if (!is_device(source) && !is_address(source) && !file_exists(source))
    throw InputError(fmt::format("{}: there is no such video", source));
  try {
    follower_ = std::make_shared<Follower>(settings);
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: cannot be opened: {}", without_password(source), error.what()));
  }
  std::thread([follower = follower_] { follower->follow(); }).detach();
}

VideoStream::~VideoStream() { follower_->end(); }

std::optional<LiveReading> VideoStream::read(double wait_s) { return follower_->read(wait_s); }
bool VideoStream::has_ended() const { return follower_->has_ended(); }
std::string VideoStream::problem() const { return follower_->problem(); }
std::vector<std::string> VideoStream::take_events() { return follower_->take_events(); }
std::vector<std::pair<std::string, std::int64_t>> VideoStream::counts() const { return follower_->counts(); }

}  // namespace incognita
