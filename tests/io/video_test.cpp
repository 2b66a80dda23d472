// Videos as recordings: times, images in any order, damage.
#include "incognita/io/recordings/video.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "incognita/io/recordings/recorded_images.hpp"
#include "incognita/io/recordings/video_images.hpp"
#include "tests/io/heard_reading.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::message_of;
using testing::Scratch;

constexpr int width = 64, height = 48;

/// Image k is gray with the value 10 k, so that it can be told from the others.
int shade(int k) { return 10 * k; }

/// FFV1 is lossless; the rate is the only time that it stores.
void write_video(const std::filesystem::path& file, int images, double rate_hz, const char* codec = "FFV1") {
  cv::VideoWriter video(file.string(), cv::CAP_FFMPEG,
                        cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]), rate_hz,
                        cv::Size(width, height));
  ASSERT_TRUE(video.isOpened()) << "FFmpeg cannot write " << codec;
  for (int k = 0; k < images; ++k) video.write(cv::Mat(height, width, CV_8UC3, cv::Scalar::all(shade(k))));
}

std::string all_notes(const Recording& recording) {
  std::string all;
  for (const std::string& note : recording.notes) all += note + "\n";
  return all;
}

int shade_of(const Recording& recording, std::size_t k) {
  const auto image = recording.images->read(k);
  EXPECT_EQ(image->width(), width);
  EXPECT_EQ(image->height(), height);
  return (*image)(width / 2, height / 2);
}

TEST(Video, HasTheTimesAndImagesThatWereWritten) {
  const Scratch scratch;
  for (const char* name : {"clip.mkv", "clip.avi"}) {
    write_video(scratch / name, 12, 25);
    const Recording recording = read_recording(scratch / name, "auto", 1);
    EXPECT_EQ(recording.format, "video");
    ASSERT_EQ(recording.frames.size(), 12u) << name;
    for (int k = 0; k < 12; ++k) {
      EXPECT_NEAR(recording.frames[static_cast<std::size_t>(k)].t, k / 25.0, 1e-3) << name << ", image " << k;
      EXPECT_NEAR(shade_of(recording, static_cast<std::size_t>(k)), shade(k), 1) << name;
    }
    EXPECT_HAS(all_notes(recording), "detected format `video`");
    EXPECT_HAS(all_notes(recording), "12 images of 64x48 px in 0.44 s");
  }
}

TEST(Video, GivesImagesInAnyOrder) {
  const Scratch scratch;
  write_video(scratch / "clip.mkv", 8, 10);
  const Recording recording = read_video(scratch / "clip.mkv");
  for (const int k : {5, 2, 2, 7, 0, 6})
    EXPECT_NEAR(shade_of(recording, static_cast<std::size_t>(k)), shade(k), 1);
}

TEST(Video, OfCompressedKindsKeepsItsRate) {
  const Scratch scratch;
  write_video(scratch / "clip.mp4", 20, 30, "mp4v");
  const Recording recording = read_video(scratch / "clip.mp4");
  ASSERT_EQ(recording.frames.size(), 20u);
  EXPECT_NEAR(recording.frames[19].t, 19 / 30.0, 1e-3);
  EXPECT_NEAR(shade_of(recording, 10), shade(10), 4);
}

TEST(Video, IsUsedUpToItsDamage) {
  const Scratch scratch;
  write_video(scratch / "whole.avi", 20, 25, "MJPG");
  const std::string bytes = contents(scratch / "whole.avi");
  scratch.write("cut.avi", bytes.substr(0, bytes.size() * 6 / 10));
  const Recording recording = read_video(scratch / "cut.avi");
  EXPECT_GE(recording.frames.size(), 2u);
  EXPECT_LT(recording.frames.size(), 20u);
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    EXPECT_NEAR(shade_of(recording, k), shade(static_cast<int>(k)), 4);
  EXPECT_HAS(all_notes(recording), "can be decoded: the rest is damaged or missing");
}

TEST(Video, CutAnywhereIsReadOrRefused) {
  const Scratch scratch;
  write_video(scratch / "whole.mkv", 6, 25);
  const std::string bytes = contents(scratch / "whole.mkv");
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 23) {
    scratch.write("cut.mkv", bytes.substr(0, size));
    try {
      const Recording recording = read_video(scratch / "cut.mkv");
      EXPECT_LE(recording.frames.size(), 6u);
      shade_of(recording, recording.frames.size() - 1);
    } catch (const InputError& error) {
      EXPECT_HAS(std::string(error.what()), "cut.mkv");
    }
  }
}

TEST(Video, SaysWhatCannotBeRead) {
  const Scratch scratch;
  scratch.write("text.mp4", "this is no video");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "text.mp4", "auto", 30); }),
             "text.mp4: cannot be opened as a video");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "none.mp4", "video", 30); }),
             "none.mp4: is not a file");
  EXPECT_HAS(message_of([&] { read_recording(scratch / "text.txt", "auto", 30); }),
             "is not a folder; a recording must be a folder, a video or a bag");
  write_video(scratch / "clip.mkv", 2, 25);
  EXPECT_HAS(message_of([&] { read_recording(scratch / "clip.mkv", "auto", 30, "*.png"); }),
             "does not apply to the format `video`");
}

/// The numbers of the images that are left in the source, by their shades.
std::vector<int> numbers_of(ImageSource& images) {
  std::vector<int> numbers;
  while (const auto found = images.next())
    numbers.push_back(found->failure.empty() ? (found->image(3, 3) + 5) / 10 : -1);
  return numbers;
}

TEST(Video, IsSpreadOverSoManyImages) {
  const Scratch scratch;
  write_video(scratch / "clip.mkv", 20, 10);
  const auto images = open_video_images(scratch / "clip.mkv", 5);
  EXPECT_EQ(images->count(), 5u);
  images->skip();
  EXPECT_HAS(images->next().value().name, "clip.mkv at 0.40 s");
  EXPECT_EQ(numbers_of(*images), (std::vector<int>{8, 12, 16}));
  EXPECT_EQ(open_video_images(scratch / "clip.mkv", 100)->count(), 20u);
}

TEST(Video, IsDecodedOnceForAllItsImages) {
  const Scratch scratch;
  write_video(scratch / "clip.mkv", 20, 10);
  testing::HeardReading listener;
  const auto images = open_video_images(scratch / "clip.mkv", 4);
  EXPECT_EQ(listener.in_words(), "images of clip.mkv");
  EXPECT_EQ(listener.heard.front().reading.total, 20u);
  EXPECT_EQ(listener.heard.front().done.back(), 20u);
  std::filesystem::remove(scratch / "clip.mkv");
  for (int pass = 0; pass < 2; ++pass, images->rewind())
    EXPECT_EQ(numbers_of(*images), (std::vector<int>{0, 5, 10, 15}));
  EXPECT_EQ(listener.heard.size(), 1u);
}

/// A Matroska file of 20 images whose header announces another number: its duration, in ms, is not true.
std::filesystem::path announcing(int number, const Scratch& scratch) {
  write_video(scratch / "whole.mkv", 20, 10);
  std::string bytes = contents(scratch / "whole.mkv");
  const std::string duration = "\x44\x89\x88";  // its identifier, and the length of a double
  const auto wrong = std::bit_cast<std::uint64_t>(100.0 * number);
  std::size_t at = bytes.find(duration) + duration.size();
  for (int shift = 56; shift >= 0; shift -= 8) bytes.at(at++) = static_cast<char>(wrong >> shift & 0xff);
  return scratch.write("wrong.mkv", bytes);
}

TEST(Video, IsSpreadWhateverNumberItAnnounces) {
  const Scratch scratch;
  testing::HeardReading listener;
  const auto more = open_video_images(announcing(4, scratch), 5);
  EXPECT_EQ(listener.heard.back().reading.total, 4u);
  EXPECT_EQ(listener.heard.size(), 1u);
  EXPECT_EQ(numbers_of(*more), (std::vector<int>{0, 4, 8, 12, 16})) << "every second one is given up twice";
  const auto one_more = open_video_images(announcing(19, scratch), 5);
  EXPECT_EQ(numbers_of(*one_more), (std::vector<int>{0, 3, 7, 11, 15})) << "none is given up for the last";
  const auto fewer = open_video_images(announcing(120, scratch), 5);
  EXPECT_EQ(listener.heard.back().reading.total, 120u);
  EXPECT_EQ(listener.heard.size(), 4u) << "it is decoded again";
  EXPECT_EQ(numbers_of(*fewer), (std::vector<int>{0, 3, 7, 11, 15})) << "the last one counts as damaged";
}

TEST(Video, BecomesTheImagesOfARun) {
  const Scratch scratch;
  write_video(scratch / "clip.mkv", 4, 25);
  const auto recording =
      std::make_shared<const Recording>(with_rounded_stamps(read_video(scratch / "clip.mkv")));
  RecordedImages images(recording, width, height);
  BodyObservation observation;
  images.measure({}, 0, {3, 0.12, 0.04}, observation);
  ASSERT_EQ(observation.images.size(), 1u);
  EXPECT_NEAR((*observation.images[0])(0, 0), shade(3), 1);
  EXPECT_HAS(message_of([&] { RecordedImages(recording, 640, 480); }), "clip.mkv: frame 0 is 64x48 px");
}

}  // namespace
}  // namespace incognita
