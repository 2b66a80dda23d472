// Image recordings with defects. The images show the rendered room, so that there are features to track.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/rendered/room_bodies.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::pgm;
using testing::Scratch;
using testing::Words;

constexpr int frames = 20, wrong_one = 12;

std::string name_of(int frame) { return fmt::format("frame{:04d}", frame); }

std::string as_pgm(const Image& image) {
  std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width(), image.height());
  for (int v = 0; v < image.height(); ++v)
    bytes.append(reinterpret_cast<const char*>(image.row(v)), static_cast<std::size_t>(image.width()));
  return bytes;
}

std::string as_png(const Image& image) {
  const cv::Mat gray(image.height(), image.width(), CV_8U, const_cast<std::uint8_t*>(image.row(0)));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", gray, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A short drift in front of the room's sheet, in a scenario `s.toml` that uses the folder `images`.
class ProgramRecording : public ::testing::Test {
 protected:
  ProgramRecording() {
    const Scenario room = load_scenario("room").scenario;
    const auto painted = std::make_shared<const Room>(room.room, 1);
    FixedRateClock clock(room.run.rate_hz, frames / room.run.rate_hz);
    SimulatedWorld world(camera_in_room(room.room, painted->layout(), 1), 1);
    RoomCamera camera(painted, make_camera(room.camera), room.room, 1);
    while (const Tick tick = clock.next())
      images_.push_back(camera.image_from(*world.move({}, tick)->bodies.at(0).pose, tick));
    scratch_.write("s.toml",
                   "[world]\ntype = \"recording\"\n[recording]\nfolder = \"" + images().string() +
                       "\"\n\n[start]\ntarget = \"targets/sheet.toml\"\n[decision]\nstrategy = \"none\"\n");
  }

  std::filesystem::path images() const { return scratch_.folder() / "images"; }
  std::filesystem::path run() const { return scratch_.folder() / "run"; }

  void write_images(const std::string& ending = ".pgm") const {
    for (int i = 0; i < frames; ++i)
      write_image(i, ending == ".png" ? as_png(*images_[i]) : as_pgm(*images_[i]), ending);
  }
  void write_image(int frame, const std::string& bytes, const std::string& ending = ".pgm") const {
    scratch_.write("images/" + name_of(frame) + ending, bytes);
  }
  Ended follow() const {
    return testing::incognita({"run", "s.toml", "--out", "run", "--no-figures"}, scratch_.folder());
  }

  /// All frames before the defective one are recorded; the message names its file.
  void expect_ends_half_way(const Words& messages) const {
    const Ended ended = follow();
    EXPECT_EQ(ended.code, 1) << ended.err;
    const nlohmann::json summary = testing::summary_of(run());
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_EQ(summary["frames"], wrong_one);
    EXPECT_EQ(summary["tracked_frames"], wrong_one);
    EXPECT_EQ(testing::lines(run() / "estimate.tum").size(), wrong_one + 1u);
    EXPECT_GT(testing::lines(run() / "map.csv").size(), 5u);
    testing::expect_whole_tables(run());
    const std::string reason = summary["reason"];
    for (const std::string& message : messages) {
      EXPECT_SAYS(reason, message);
      EXPECT_SAYS(ended.err, message);
    }
  }

  void expect_never_begins(const Words& messages) const {
    const Ended ended = follow();
    EXPECT_EQ(ended.code, 2) << ended.err;
    for (const std::string& message : messages) EXPECT_SAYS(ended.err, message);
    EXPECT_FALSE(exists(run()));
  }

  Scratch scratch_;
  std::vector<std::shared_ptr<const Image>> images_;
};

TEST_F(ProgramRecording, IsProcessedToItsEnd) {
  write_images();
  const Ended ended = follow();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "20 images, frame0000.pgm to frame0019.pgm, at 30 Hz by run.rate_hz");
  EXPECT_EQ(testing::summary_of(run())["tracked_frames"], frames);
  EXPECT_FALSE(exists(run() / "truth.tum"));
}

TEST_F(ProgramRecording, StopsAtAMissingImage) {
  write_images();
  std::string list;
  for (int i = 0; i < frames; ++i) list += fmt::format("{} {}.pgm\n", i / 30.0, name_of(i));
  scratch_.write("images/rgb.txt", list);
  std::filesystem::remove(images() / (name_of(wrong_one) + ".pgm"));
  expect_ends_half_way({"at frame 12", "frame0012.pgm: cannot be read: No such file", "run.duration_s"});
}

TEST_F(ProgramRecording, DoesNotDependOnTheOriginAndTheDigitsOfTheStamps) {
  write_images();
  const auto poses = [&](double offset_s, int decimals) {
    std::string list;
    for (int i = 0; i < frames; ++i)
      list += fmt::format("{:.{}f} {}.pgm\n", i / 30.0 + offset_s, decimals, name_of(i));
    scratch_.write("images/rgb.txt", list);
    const Ended ended = follow();
    EXPECT_EQ(ended.code, 0) << ended.err;
    std::vector<std::string> rows = testing::lines(run() / "estimate.tum");
    for (std::string& row : rows) row = row.substr(row.find(' '));
    return rows;
  };
  const std::vector<std::string> recorded = poses(0, 12);
  ASSERT_EQ(recorded.size(), frames + 1u);
  EXPECT_EQ(poses(0, 6), recorded);
  EXPECT_EQ(poses(1000, 12), recorded);
  EXPECT_EQ(poses(1000, 6), recorded);
}

TEST_F(ProgramRecording, ReportsMissingNumbers) {
  write_images();
  for (const int gone : {7, 16, 17}) std::filesystem::remove(images() / (name_of(gone) + ".pgm"));
  const Ended ended = follow();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "3 numbers are missing, the first between frame0006.pgm and frame0008.pgm");
}

TEST_F(ProgramRecording, StopsAtATruncatedPgm) {
  write_images();
  write_image(wrong_one, as_pgm(*images_[wrong_one]).substr(0, 40'000));
  expect_ends_half_way({"frame0012.pgm: the file is truncated", "replace the file or end before it"});
}

TEST_F(ProgramRecording, StopsAtATruncatedPng) {
  write_images(".png");
  const std::string whole = as_png(*images_[wrong_one]);
  write_image(wrong_one, whole.substr(0, whole.size() / 2), ".png");
  expect_ends_half_way({"frame0012.png: the file is truncated"});
}

TEST_F(ProgramRecording, StopsAtADamagedPng) {
  write_images(".png");
  std::string damaged = as_png(*images_[wrong_one]);
  for (std::size_t i = damaged.size() / 2; i < damaged.size() / 2 + 64; ++i)
    damaged[i] = static_cast<char>(~damaged[i]);
  write_image(wrong_one, damaged, ".png");
  expect_ends_half_way({"frame0012.png"});
}

TEST_F(ProgramRecording, StopsAtAnImageOfAnotherSize) {
  write_images();
  write_image(wrong_one, pgm(160, 120));
  expect_ends_half_way({"frame0012.pgm: frame 12 is 160x120 px", "camera.width_px", "320x240"});
}

TEST_F(ProgramRecording, StopsAtAFolderNamedLikeAnImage) {
  write_images();
  const auto file = images() / (name_of(wrong_one) + ".pgm");
  std::string list;
  for (int i = 0; i < frames; ++i) list += fmt::format("{} {}.pgm\n", i / 30.0, name_of(i));
  scratch_.write("images/rgb.txt", list);
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  expect_ends_half_way({"frame0012.pgm: is a folder"});
}

TEST_F(ProgramRecording, DoesNotStartWithAWrongFirstImage) {
  write_images();
  write_image(0, "");
  expect_never_begins({"frame0000.pgm: the file is empty"});
  write_image(0, "GIF89a, they said");
  expect_never_begins({"frame0000.pgm: is not an image that can be decoded"});
  write_image(0, pgm(32, 24));
  expect_never_begins({"frame0000.pgm: frame 0 is 32x24 px", "camera.width_px"});
}

TEST_F(ProgramRecording, DoesNotStartWithoutImages) {
  expect_never_begins({"s.toml:4: recording.folder: ", "images does not exist"});
  std::filesystem::create_directory(images());
  expect_never_begins({"images: there are no images in this folder"});
  scratch_.write("images/deeper/frame0000.pgm", pgm(320, 240));
  expect_never_begins({"images: there are no images in this folder; it has the folders deeper"});
  std::filesystem::remove_all(images());
  scratch_.write("images", "a file");
  expect_never_begins({"images: is not a folder; a recording must be a folder"});
}

}  // namespace
}  // namespace incognita
