// A video as a live camera: its own pace, dropped images, what cannot be opened.
#include "incognita/io/cameras/video_stream.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

void write_clip(const std::filesystem::path& file, int images, double rate_hz) {
  cv::VideoWriter video(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), rate_hz,
                        cv::Size(64, 48));
  ASSERT_TRUE(video.isOpened());
  for (int k = 0; k < images; ++k) video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(10 * k)));
}

TEST(VideoStream, PlaysAFileInItsOwnTime) {
  const Scratch scratch;
  write_clip(scratch / "clip.mkv", 10, 20);
  const auto start = std::chrono::steady_clock::now();
  VideoStream stream({(scratch / "clip.mkv").string()});
  std::vector<LiveReading> readings;
  while (!stream.has_ended())
    if (auto reading = stream.read(0.05)) readings.push_back(*reading);
  while (auto reading = stream.read(0)) readings.push_back(*reading);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_GE(took.count(), 9 / 20.0 - 0.01) << "not faster than its images were taken";
  ASSERT_GE(readings.size(), 2u);
  EXPECT_EQ(static_cast<std::int64_t>(readings.size()) + stream.counts().front().second, 10)
      << "used or counted as dropped";
  for (const LiveReading& reading : readings) {
    const double k = reading.t * 20;
    EXPECT_NEAR(k, std::round(k), 0.03) << "the times of the file";
    EXPECT_NEAR((*reading.image)(5, 5), 10 * std::round(k), 1) << "each image with its own";
  }
  EXPECT_EQ(stream.problem(), "");
}

TEST(VideoStream, DropsWhatNobodyTakes) {
  const Scratch scratch;
  write_clip(scratch / "clip.mkv", 12, 60);
  VideoStream stream({(scratch / "clip.mkv").string()});
  while (!stream.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const auto last = stream.read(0);
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->t, 11 / 60.0, 2e-3);
  EXPECT_EQ(stream.counts().front(), (std::pair<std::string, std::int64_t>("camera_dropped_images", 11)));
}

TEST(VideoStream, DoesNotWaitForAJumpInTheTimesOfAFile) {
  const Scratch scratch;
  write_clip(scratch / "clip.mkv", 4, 0.1);
  VideoStream stream({(scratch / "clip.mkv").string()});
  const auto start = std::chrono::steady_clock::now();
  const auto took_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  while (!stream.has_ended() && took_s() < 9) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(stream.has_ended()) << "three pauses of 10 s are none";
  EXPECT_TRUE(stream.read(0));
}

TEST(VideoStream, SaysWhatCannotBeOpened) {
  const Scratch scratch;
  scratch.write("text.mp4", "no video");
  EXPECT_HAS(message_of([&] { VideoStream({(scratch / "text.mp4").string()}); }),
             "text.mp4: cannot be opened");
  EXPECT_HAS(message_of([&] { VideoStream({(scratch / "none.mp4").string()}); }),
             "none.mp4: there is no such video");
  EXPECT_HAS(message_of([&] { VideoStream({"/dev/video-that-is-not-there"}); }), "is it plugged in");
  EXPECT_HAS(message_of([&] { VideoStream({"http://127.0.0.1:9/none"}); }), "Connection refused");
}

TEST(VideoStream, EndsAtOnceWhenNobodyNeedsItAnyMore) {
  const Scratch scratch;
  write_clip(scratch / "clip.mkv", 5, 0.5);
  const auto start = std::chrono::steady_clock::now();
  { VideoStream stream({(scratch / "clip.mkv").string()}); }
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2);
}

}  // namespace
}  // namespace incognita
