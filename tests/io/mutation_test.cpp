// Readers of targets, images and recordings under hundreds of small damages: an answer or a refusal, never
// more.
#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "incognita/io/image_file.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/io/target_file.hpp"
#include "incognita/math/random.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::pgm;
using testing::Scratch;

/// One to four bytes changed, left out, put in or repeated; sometimes the rest is gone.
std::string damaged(std::string text, RandomStream& random) {
  static constexpr const char* words[] = {
      "nan", "-inf", "1e999", "-", "[", "\"", "\n", "99999999999999999999", ","};
  for (int n = 1 + random.below(4); n > 0 && !text.empty(); --n) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
    switch (random.below(6)) {
      case 0:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        text.erase(at, 1 + static_cast<std::size_t>(random.below(8)));
        break;
      case 2:
        text.insert(at, words[random.below(std::size(words))]);
        break;
      case 3:
        text.insert(at, text.substr(at, 20));
        break;
      case 4:
        text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
        break;
      default:
        if (random.below(8) == 0) text.resize(at);
    }
  }
  return text;
}

/// How many of the damaged files were still read. `read` may throw what a reader may.
int still_read(const std::string& whole, int times, const std::function<void(const std::string&)>& read) {
  RandomStream random(1, "damage");
  int fine = 0;
  for (int i = 0; i < times; ++i) {
    const std::string text = damaged(whole, random);
    try {
      read(text);
      ++fine;
    } catch (const std::runtime_error& error) {  // InputError is one
      EXPECT_FALSE(std::string(error.what()).empty());
    }
  }
  return fine;
}

TEST(DamagedTarget, IsReadOrRefused) {
  const Scratch scratch;
  scratch.write("p.pgm", pgm(11, 11));
  std::string whole = "name = \"sheet\"\nnormal = [-1, 0, 0]\naxes = \"world\"\n";
  for (const char* at : {"[3, 0.2, 1]", "[3, -0.2, 1]", "[3, 0.2, 1.5]", "[3, -0.2, 1.5]"})
    whole += std::string("[[corner]]\nposition_m = ") + at + "\npatch = \"p.pgm\"\n";
  const int fine = still_read(whole, 300, [&](const std::string& text) {
    const Target target = read_target(scratch.write("t.toml", text));
    EXPECT_NEAR(target.normal.norm(), 1, 1e-9);
    EXPECT_GE(target.corners.size(), 4u);
    for (const auto& corner : target.corners) EXPECT_TRUE(corner.position.allFinite());
  });
  EXPECT_GT(fine, 10);
  EXPECT_LT(fine, 290);
}

TEST(DamagedImage, IsReadOrRefused) {
  const Scratch scratch;
  cv::Mat picture(24, 32, CV_8U);
  for (int i = 0; i < 24 * 32; ++i) picture.data[i] = static_cast<unsigned char>(i * 7 + i / 32 * 5);
  for (const char* ending : {".pgm", ".png", ".jpg", ".bmp", ".tiff", ".webp"}) {
    std::vector<unsigned char> bytes;
    ASSERT_TRUE(cv::imencode(ending, picture, bytes));
    const std::filesystem::path file = scratch.folder() / (std::string("image") + ending);
    const int fine = still_read({bytes.begin(), bytes.end()}, 60, [&](const std::string& text) {
      const Image image = read_image(scratch.write(file.filename(), text));
      EXPECT_GT(image.width(), 0) << ending;
      EXPECT_GT(image.height(), 0) << ending;
    });
    EXPECT_LT(fine, 60) << ending;
  }
}

TEST(DamagedRecording, IsReadOrRefused) {
  const Scratch scratch;
  const std::string list = "# stamp file\n1.0 rgb/a.png\n1.1 rgb/b.png\n1.2 rgb/c.png\n";
  const std::string truth =
      "# t x y z qx qy qz qw\n1.0 0 0 1 0 0 0 1\n1.1 0.5 0 1 0 0 0.6 0.8\n1.2 1 0 1 0 0 0 1\n";
  const auto read = [&](const std::string& a, const std::string& b) {
    scratch.write("rgb.txt", a);
    scratch.write("groundtruth.txt", b);
    const Recording recording = read_recording(scratch.folder(), "tum", 30);
    EXPECT_FALSE(recording.frames.empty());
    for (std::size_t i = 1; i < recording.frames.size(); ++i)
      EXPECT_LT(recording.frames[i - 1].t, recording.frames[i].t);
    for (const RecordedPose& pose : recording.truth) {
      EXPECT_TRUE(std::isfinite(pose.t) && pose.position.allFinite());
      EXPECT_NEAR(pose.world_from_camera.norm(), 1, 1e-9);
    }
  };
  EXPECT_GT(still_read(list, 150, [&](const std::string& text) { read(text, truth); }), 15);
  EXPECT_GT(still_read(truth, 150, [&](const std::string& text) { read(list, text); }), 5);
}

}  // namespace
}  // namespace incognita
