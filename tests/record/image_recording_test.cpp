#include "incognita/record/image_recording.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "file_size_limit.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/tum.hpp"
#include "synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

Snapshot with_image(int frame) {
  Snapshot snapshot = testing::synthetic_snapshot({}, frame);
  auto image = std::make_shared<Image>(32, 24, std::uint8_t{100});
  (*image)(3, 5) = static_cast<std::uint8_t>(frame);
  snapshot.image = image;
  return snapshot;
}

TEST(ImageRecording, HasTheLayoutOfTum) {
  const testing::Scratch scratch;
  {
    ImageRecording recording(scratch.folder());
    for (const int frame : {7, 8, 9}) recording.publish(with_image(frame));
    Snapshot blind = with_image(10);
    blind.image.reset();
    recording.publish(blind);
  }
  const std::vector<std::string> times = testing::lines(scratch / "recording/rgb.txt");
  ASSERT_EQ(times.size(), 4u);
  EXPECT_NEAR(std::stod(times[2]), with_image(8).tick.t, 1e-9);
  EXPECT_HAS(times[2], " rgb/frame-000008.png");
  const cv::Mat image =
      cv::imread((scratch / "recording/rgb/frame-000008.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(image.type(), CV_8UC1);
  EXPECT_EQ(image.at<std::uint8_t>(5, 3), 8);
  const Trajectory truth = read_trajectory(scratch / "recording/groundtruth.txt");
  ASSERT_EQ(truth.size(), 3u);
  EXPECT_EQ(truth[1].position, with_image(8).bodies.at(0).truth->position);
  EXPECT_FALSE(std::filesystem::exists(scratch / "recording/rgb/frame-000010.png"));
}

TEST(ImageRecording, ListsWholeImagesOnly) {
  const testing::Scratch scratch;
  ImageRecording recording(scratch.folder());
  const testing::FileSizeLimit limit(50);
  EXPECT_THROW(recording.publish(with_image(1)), RecordError);
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "recording/rgb"));
}

}  // namespace
}  // namespace incognita
