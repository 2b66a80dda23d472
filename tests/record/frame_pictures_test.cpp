#include "incognita/record/frame_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "file_size_limit.hpp"
#include "incognita/messages/errors.hpp"
#include "synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

Snapshot with_image() {
  Snapshot snapshot = testing::synthetic_snapshot({}, 50);
  auto image = std::make_shared<Image>(320, 240, std::uint8_t{100});
  snapshot.image = image;
  return snapshot;
}

TEST(FramePictures, ColorMatchesByOutcome) {
  const testing::Scratch scratch;
  FramePictures(scratch.folder(), 11).publish(with_image());
  const cv::Mat picture = cv::imread((scratch / "frames/frame-000050.png").string());
  ASSERT_EQ(picture.cols, 640);
  ASSERT_GT(picture.rows, 480);
  int greenish = 0, reddish = 0, plain = 0;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const auto c = picture.at<cv::Vec3b>(v, u);
      greenish += c[1] > 200 && c[2] < 100;
      reddish += c[2] > 200 && c[1] < 100 && c[0] < 100;
      plain += c == cv::Vec3b(100, 100, 100);
    }
  EXPECT_GT(greenish, 200);
  EXPECT_GT(reddish, 20);
  EXPECT_GT(plain, 640 * 480 / 2);
}

TEST(FramePictures, AcceptNonFiniteValuesAndMissingImages) {
  const testing::Scratch scratch;
  FramePictures pictures(scratch.folder(), 11);
  Snapshot snapshot = with_image();
  snapshot.matches[0].innovation_cov.setConstant(std::nan(""));
  snapshot.matches[1].predicted.setConstant(1e300);
  snapshot.matches[1].measured.reset();
  snapshot.matches[2].innovation_cov.setIdentity();
  snapshot.matches[2].innovation_cov *= 1e30;
  pictures.publish(snapshot);
  EXPECT_TRUE(std::filesystem::exists(scratch / "frames/frame-000050.png"));
  snapshot.image.reset();
  snapshot.tick.frame = 51;
  pictures.publish(snapshot);
  EXPECT_FALSE(std::filesystem::exists(scratch / "frames/frame-000051.png"));
}

TEST(FramePictures, AreWholeOrAbsent) {
  const testing::Scratch scratch;
  FramePictures pictures(scratch.folder(), 11);
  const testing::FileSizeLimit limit(200);
  EXPECT_THROW(pictures.publish(with_image()), RecordError);
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "frames"));
}

}  // namespace
}  // namespace incognita
