// From the sheet that `incognita target --print` makes, on a wall nearer than most rooms are deep, to a map: by the defaults for a
// camera in a hand.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "incognita/io/recordings/true_poses.hpp"
#include "incognita/io/targets/printed_target.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "tests/app/program.hpp"
#include "tests/io/photographed_sheet.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;
using testing::Sheet;

const PinholeCamera webcam{320, 240, 260, 260, 159.5, 119.5, 0, 0, 0, 0, 0};
constexpr double rate_hz = 30;
constexpr int frames = 45;

/// A wall of 2.4 x 1.8 m, covered with rectangles, on which the sheet hangs.
Sheet wall_with_sheet() {
  constexpr double px_per_mm = 1;
  Sheet wall{Image(2400, 1800), 2.4, 1.8};
  RandomStream random(5, "wall");
  const auto fill = [&](int left, int top, int width, int height, std::uint8_t gray) {
    for (int v = top; v < std::min(top + height, wall.image.height()); ++v)
      for (int u = left; u < std::min(left + width, wall.image.width()); ++u) wall.image(u, v) = gray;
  };
  fill(0, 0, wall.image.width(), wall.image.height(), 150);
  for (int i = 0; i < 900; ++i)
    fill(static_cast<int>(random.below(2400)), static_cast<int>(random.below(1800)),
         10 + static_cast<int>(random.below(90)), 10 + static_cast<int>(random.below(90)),
         static_cast<std::uint8_t>(40 + random.below(200)));
  const Image sheet = target_sheet_image(*paper_of("a4"), px_per_mm);
  const int left = (wall.image.width() - sheet.width()) / 2, top = (wall.image.height() - sheet.height()) / 2;
  for (int v = 0; v < sheet.height(); ++v)
    for (int u = 0; u < sheet.width(); ++u) wall.image(left + u, top + v) = sheet(u, v);
  return wall;
}

/// Half a meter before the wall, moving sideways and turning.
Eigen::Vector3d position_at(double t) {
  return {-0.55 - 0.1 * std::sin(0.7 * t), 0.1 + 0.25 * std::sin(0.9 * t), 0.03 + 0.12 * std::sin(1.3 * t)};
}

void write_pgm(const Image& image, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << image.width() << ' ' << image.height() << "\n255\n";
  for (int v = 0; v < image.height(); ++v)
    out.write(reinterpret_cast<const char*>(image.row(v)), image.width());
}

TEST(NearSheet, OnAWallStartsAMapInMetersWhoseLandmarksAreAsNear) {
  const Scratch scratch;
  ASSERT_EQ(testing::incognita({"target", "--print", "--out", "sheet.pdf"}, scratch.folder()).code, 0);
  std::filesystem::create_directories(scratch / "frames");
  const Sheet wall = wall_with_sheet();
  for (int k = 0; k < frames; ++k) {
    const Eigen::Vector3d position = position_at(k / rate_hz);
    const Eigen::Vector3d at(0, 0.02 + 0.15 * std::sin(0.8 * k / rate_hz), 0.01);
    write_pgm(testing::photograph_sheet(wall, webcam, position, testing::gaze_at(at, position)),
              scratch / ("frames/" + std::to_string(k) + ".pgm"));
  }
  scratch.write(
      "mine.toml",
      "[world]\ntype = \"recording\"\n[recording]\nfolder = \"frames\"\n[camera]\nmodel = \"pinhole\"\n"
      "fu_px = 260\nfv_px = 260\n[start]\nfrom = \"target\"\ntarget = \"sheet.toml\"\n");
  const Ended done =
      testing::incognita({"run", "mine.toml", "--no-figures", "--out", "out"}, scratch.folder());
  EXPECT_EQ(done.code, 0) << done.err;
  const std::vector<RecordedPose> poses = read_tum_poses(scratch / "out/estimate.tum");
  ASSERT_GE(poses.size(), frames - 2u);
  double most_m = 0;
  for (const RecordedPose& pose : poses)
    most_m = std::max(most_m, (pose.position - position_at(pose.t)).norm());
  EXPECT_LT(most_m, 0.015);
}

}  // namespace
}  // namespace incognita
