#include "incognita/io/recordings/video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/gray_image.hpp"
#include "incognita/io/formats/reading_progress.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Throws std::runtime_error naming the file.
cv::VideoCapture opened(const std::filesystem::path& file) {
  cv::VideoCapture video;
  try {
    video.open(file.string(), cv::CAP_FFMPEG);
  } catch (const cv::Exception&) {
    // reported below
  }
  if (!video.isOpened())
    throw std::runtime_error(
        fmt::format("{}: cannot be opened as a video: it is damaged, or of a kind that FFmpeg does not know",
                    file.string()));
  video.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // the calibration belongs to the sensor
  return video;
}

/// The image that was grabbed last.
Image retrieved(cv::VideoCapture& video, const std::filesystem::path& file, std::size_t number) {
  cv::Mat decoded;
  if (!video.retrieve(decoded) || decoded.empty())
    throw std::runtime_error(fmt::format("{}: image {} cannot be decoded", file.string(), number));
  return gray_image(decoded);
}

/// Decodes forward, and from the start again for an image before the last.
class VideoImages final : public IndexedImages {
 public:
  explicit VideoImages(std::filesystem::path file) : file_(std::move(file)) {}

  std::shared_ptr<const Image> read(std::size_t frame) override {
    if (!video_.isOpened() || frame < next_) video_ = opened(file_), next_ = 0;
    for (; next_ <= frame; ++next_)
      if (!video_.grab())
        throw std::runtime_error(fmt::format("{}: image {} cannot be decoded", file_.string(), next_));
    return std::make_shared<const Image>(retrieved(video_, file_, frame));
  }

 private:
  std::filesystem::path file_;
  cv::VideoCapture video_;
  std::size_t next_ = 0;  ///< number of the image that grab() yields
};

using VideoVisit = std::function<void(const PassingImage&)>;

/// By the header of the file; 0 if that is no number of images.
double announced_images(cv::VideoCapture& video) {
  constexpr double most = 1e9;
  const double announced = video.get(cv::CAP_PROP_FRAME_COUNT);
  return announced > 0 && announced < most ? announced : 0;
}

/// s, of each image, as the file has them.
std::vector<double> stored_times(const std::filesystem::path& file, cv::VideoCapture& video,
                                 const VideoVisit& visit) {
  const auto announced = static_cast<std::size_t>(announced_images(video));
  ReportedReading reading(file, "images", announced);
  std::vector<double> times;
  while (video.grab()) {
    const std::size_t number = times.size();
    times.push_back(video.get(cv::CAP_PROP_POS_MSEC) / 1000);
    if (visit) visit({number, announced, [&] { return retrieved(video, file, number); }});
    reading.done(times.size());
  }
  return times;
}

bool increase(const std::vector<double>& times) {
  return std::is_sorted(times.begin(), times.end(), [](double a, double b) { return a <= b; });
}

/// Stored times that do not increase are replaced by the rate in the header of the file.
std::vector<double> times_of(const std::filesystem::path& file, cv::VideoCapture& video,
                             const VideoVisit& visit, std::vector<std::string>& notes) {
  std::vector<double> times = stored_times(file, video, visit);
  if (times.empty())
    throw InputError(
        fmt::format("{}: not one image can be decoded; convert it, e.g. to H.264 in mp4", file.string()));
  const double rate = video.get(cv::CAP_PROP_FPS);
  if (times.size() == 1 || increase(times)) {
    for (std::size_t i = times.size(); i-- > 0;) times[i] -= times.front();
    return times;
  }
  if (!(std::isfinite(rate) && rate > 0))
    throw InputError(
        fmt::format("{}: has neither times nor a rate; extract its images into a folder, and set run.rate_hz",
                    file.string()));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / rate;
  notes.push_back(
      fmt::format("the times in the video do not increase: they follow from its rate, {} Hz", rate));
  return times;
}

/// The last image before a damaged place may be incomplete, which the decoder does not tell.
void drop_the_last_of_a_damaged_video(double announced, std::vector<double>& times,
                                      std::vector<std::string>& notes) {
  if (!(announced > static_cast<double>(times.size()) + 0.5) || times.size() < 2) return;
  notes.push_back(fmt::format(
      "the video announces {:.0f} images, and {} can be decoded: the rest is damaged or missing, and the last of "
      "these is not used",
      announced, times.size()));
  times.pop_back();
}

}  // namespace

bool looks_like_video(const std::filesystem::path& file) {
  static constexpr const char* endings[] = {".mp4", ".avi",  ".mkv",  ".mov", ".m4v",
                                            ".mpg", ".mpeg", ".webm", ".ogv", ".wmv"};
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return file_exists(file) && std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

Recording read_video(const std::filesystem::path& file, const VideoVisit& visit) {
  if (!file_exists(file)) throw InputError(fmt::format("{}: is not a file", file.string()));
  Recording recording{"video", file, {}, {}, {}, {}};
  try {
    cv::VideoCapture video = opened(file);
    const double announced = announced_images(video);
    std::vector<double> times = times_of(file, video, visit, recording.notes);
    drop_the_last_of_a_damaged_video(announced, times, recording.notes);
    for (const double t : times) recording.frames.push_back({t, {}});
    recording.notes.push_back(fmt::format("{} images of {}x{} px in {:.2f} s", times.size(),
                                          video.get(cv::CAP_PROP_FRAME_WIDTH),
                                          video.get(cv::CAP_PROP_FRAME_HEIGHT), times.back()));
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  } catch (const cv::Exception& error) {
    throw InputError(fmt::format("{}: cannot be decoded: {}", file.string(), error.err));
  }
  recording.images = std::make_shared<VideoImages>(file);
  return recording;
}

}  // namespace incognita
