// The target to print, and a start from the sheet.
#include "incognita/io/targets/printed_target.hpp"

#include <gtest/gtest.h>

#include "incognita/io/scenario/target_file.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/features/target_pose.hpp"
#include "tests/io/photographed_sheet.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::gaze_at;
using testing::photograph_sheet;
using testing::Scratch;
using testing::Sheet;
using testing::SheetLight;

const PinholeCamera webcam{640, 480, 540, 540, 322, 238, 0, 0, 0, 0, 0};

/// Through the files that the program writes.
Target target_as_read(const NewTarget& made) {
  const Scratch scratch;
  for (const auto& [name, content] : target_files(made, "printed")) scratch.write(name, content);
  return read_target(scratch / "printed.toml");
}

Sheet sheet_of(const Paper& paper) {
  return {target_sheet_image(paper, 4), paper.width_mm / 1000, paper.height_mm / 1000};
}

struct Start {
  TargetSearch search;
  double off_m = 0;       ///< error of the position
  double off_sigmas = 0;  ///< the same as Mahalanobis distance
};

Start start_from(const Target& target, const Sheet& sheet, const Camera& camera,
                 const Eigen::Vector3d& position, double roll = 0, const SheetLight& light = {}) {
  const Image image =
      photograph_sheet(sheet, camera, position, gaze_at({0, 0.02, -0.01}, position, roll), light);
  SummedImage summed;
  summed.assign(image);
  Start start;
  start.search = find_target(target, camera, summed, 0.1);
  if (!start.search.pose) return start;
  const Eigen::Vector3d off = start.search.pose->position - position;
  start.off_m = off.norm();
  start.off_sigmas =
      std::sqrt(off.dot(start.search.pose->covariance.topLeftCorner<3, 3>().ldlt().solve(off)));
  return start;
}

TEST(PrintedTarget, IsAFileThatIsRead) {
  const Target target = target_as_read(printed_target(*paper_of("a4")));
  EXPECT_EQ(target.name, "printed");
  EXPECT_EQ(target.normal, Eigen::Vector3d(-1, 0, 0));
  ASSERT_EQ(target.corners.size(), 8u);
  EXPECT_EQ(target.corners[0].position, Eigen::Vector3d(0, 0.105, 0.07425));  // upper left: y is to the left
  EXPECT_EQ(target.corners[2].position, Eigen::Vector3d(0, -0.105, -0.07425));  // lower right
  ASSERT_TRUE(target.picture);
}

/// The corner is the center pixel: of an outer corner a quarter of it is black, of an inner one three quarters.
TEST(PrintedTarget, HasItsCornersInTheMiddleOfThePatches) {
  const NewTarget target = printed_target(*paper_of("letter"));
  for (std::size_t i = 0; i < 8; ++i) {
    const Image& patch = target.corners[i].patch;
    ASSERT_EQ(patch.width(), 15);
    EXPECT_NEAR(patch(7, 7), i < 4 ? 191 : 64, 3) << i;
  }
  const Image& upper_left = target.corners[0].patch;
  EXPECT_EQ(upper_left(0, 0), 255);
  EXPECT_EQ(upper_left(14, 0), 255);
  EXPECT_EQ(upper_left(14, 14), 0);
}

TEST(PrintedTarget, StartsACamera) {
  for (const char* word : {"a4", "letter"}) {
    const Paper paper = *paper_of(word);
    const Target target = target_as_read(printed_target(paper));
    const Sheet sheet = sheet_of(paper);
    for (const Eigen::Vector3d& position :
         {Eigen::Vector3d(-0.4, 0.1, 0.05), {-0.6, -0.2, 0.1}, {-0.8, 0.35, -0.2}}) {
      const Start start = start_from(target, sheet, webcam, position);
      ASSERT_TRUE(start.search.pose) << position.transpose() << ": " << start.search.reason;
      EXPECT_LT(start.off_m, 0.005) << position.transpose();
      EXPECT_LT(start.off_sigmas, 4) << position.transpose();
    }
  }
}

/// Cameras of 320x240 with much distortion, and light from the side.
TEST(PrintedTarget, StartsOtherCamerasInUnevenLight) {
  const Paper paper = *paper_of("a4");
  const Target target = target_as_read(printed_target(paper));
  const Sheet sheet = sheet_of(paper);
  const Camera cameras[] = {WideAngleCamera{320, 240, 195, 195, 162, 125, 9e-6},
                            FisheyeCamera{640, 480, 280, 280, 320, 240, 0.02, -0.01, 0.003, -0.001},
                            PinholeCamera{640, 480, 520, 520, 320, 240, -0.28, 0.09, 0, 0, 0}};
  for (const Camera& camera : cameras) {
    const Start start =
        start_from(target, sheet, camera, {-0.5, 0.15, 0.1}, 0.2, {.slope = 0.4, .sigma_gray = 3});
    ASSERT_TRUE(start.search.pose) << start.search.reason;
    EXPECT_LT(start.off_m, 0.012);
  }
}

/// A plain rectangle would start the camera in a pose that is wrong by half a turn.
TEST(PrintedTarget, UpsideDownIsNoticed) {
  const Paper paper = *paper_of("a4");
  const NewTarget made = printed_target(paper);
  const Target target = target_as_read(made);
  Target plain = target;
  plain.corners.resize(4);
  plain.picture.reset();
  const Sheet sheet = sheet_of(paper);
  const Eigen::Vector3d position(-0.5, 0.1, 0.1);
  const double half_turn = 3.14159265358979;
  const Start wrong = start_from(plain, sheet, webcam, position, half_turn);
  ASSERT_TRUE(wrong.search.pose);
  EXPECT_GT(wrong.off_m, 0.1);
  const Start refused = start_from(target, sheet, webcam, position, half_turn);
  EXPECT_FALSE(refused.search.pose);
  EXPECT_HAS(refused.search.reason, "like its picture to ");
}

/// The covariance of a start from eight corners is smaller than that from the rectangle alone.
TEST(PrintedTarget, IsMoreAccurateThanARectangle) {
  const Paper paper = *paper_of("a4");
  const Target target = target_as_read(printed_target(paper));
  Target plain = target;
  plain.corners.resize(4);
  const Sheet sheet = sheet_of(paper);
  const auto variance = [&](const Target& used) {
    const Start start = start_from(used, sheet, webcam, {-0.6, -0.2, 0.1});
    return start.search.pose ? start.search.pose->covariance.topLeftCorner<3, 3>().trace() : NAN;
  };
  EXPECT_LT(variance(target), 0.9 * variance(plain));
}

TEST(PrintedTarget, IsAPageOfTrueSize) {
  const std::string pdf = target_pdf(*paper_of("a4"));
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_HAS(pdf, "/MediaBox [ 0 0 841.889764 595.275591 ]");  // 297 x 210 mm in points of 1/72 inch
  EXPECT_HAS(pdf, "%%EOF");
  EXPECT_EQ(pdf, target_pdf(*paper_of("a4"))) << "the same bytes each time";
  EXPECT_HAS(target_pdf(*paper_of("letter")), "/MediaBox [ 0 0 792 612 ]");
  EXPECT_FALSE(paper_of("a5"));
}

/// The line of 100 mm, by its pixels.
TEST(PrintedTarget, HasALineOf100Millimeters) {
  const Paper paper = *paper_of("a4");
  const Image image = target_sheet_image(paper, 10, 0, 255);
  const int v = static_cast<int>(10 * (210 / 2.0 + 148.5 / 2 + 12));
  int first = -1, last = -1;
  for (int u = 0; u < image.width(); ++u)
    if (image(u, v) < 128) last = u, first = first < 0 ? u : first;
  EXPECT_NEAR(last + 1 - first, 1000, 3);
  EXPECT_NEAR((last + first) / 2.0, 2970 / 2.0, 2);
}

}  // namespace
}  // namespace incognita
