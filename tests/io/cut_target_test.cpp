// A target cut from a photograph, a start from it, and photographs that are of no use.
#include "incognita/io/targets/cut_target.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "incognita/io/scenario/target_file.hpp"
#include "incognita/io/targets/printed_target.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/slam/features/target_pose.hpp"
#include "tests/io/photographed_sheet.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::gaze_at;
using testing::message_of;
using testing::photograph_sheet;
using testing::Scratch;
using testing::Sheet;

const PinholeCamera straight{640, 480, 540, 540, 322, 238, 0, 0, 0, 0, 0};
const PinholeCamera distorted{640, 480, 520, 520, 320, 240, -0.28, 0.09, 0, 0, 0};
constexpr double width_m = 0.21, height_m = 0.1485;

/// A poster on the wall: the printed sheet, of which the file is not used.
Sheet poster() {
  const Paper paper = *paper_of("a4");
  return {target_sheet_image(paper, 4), paper.width_mm / 1000, paper.height_mm / 1000};
}

struct TestPhotograph {
  Image image;
  std::array<Eigen::Vector2d, 4> corners_px;
};

TestPhotograph photograph_from(const Eigen::Vector3d& position, const Camera& camera) {
  const Eigen::Matrix3d R = gaze_at({0, 0, 0}, position);
  TestPhotograph photograph{photograph_sheet(poster(), camera, position, R), {}};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner(0, (i == 0 || i == 3 ? 1 : -1) * width_m / 2,
                                 (i < 2 ? 1 : -1) * height_m / 2);
    photograph.corners_px[static_cast<std::size_t>(i)] =
        camera.project(R.transpose() * (corner - position))->pixel;
  }
  return photograph;
}

TargetCut cut_at(const std::array<Eigen::Vector2d, 4>& corners_px) {
  return {corners_px, width_m, height_m, std::nullopt};
}

Target cut_as_read(const NewTarget& made) {
  const Scratch scratch;
  for (const auto& [name, content] : target_files(made, "poster")) scratch.write(name, content);
  return read_target(scratch / "poster.toml");
}

double error_of_start(const Target& target, const Camera& camera, const Eigen::Vector3d& position) {
  const Image image = photograph_sheet(poster(), camera, position, gaze_at({0, 0.02, 0.01}, position));
  SummedImage summed;
  summed.assign(image);
  const TargetSearch search = find_target(target, camera, summed, 0.1);
  EXPECT_TRUE(search.pose) << search.reason;
  return search.pose ? (search.pose->position - position).norm() : NAN;
}

/// The corners are read off to 2 px; the photograph is oblique.
TEST(CutTarget, StartsACamera) {
  TestPhotograph photograph = photograph_from({-0.45, 0.2, 0.12}, straight);
  for (Eigen::Vector2d& corner : photograph.corners_px) corner += Eigen::Vector2d(1.4, -1.4);
  const CutTarget made = cut_target(photograph.image, cut_at(photograph.corners_px));
  EXPECT_HAS(made.notes.front(), "corner 0 (upper left) is at (");
  const Target target = cut_as_read(made.target);
  ASSERT_EQ(target.corners.size(), 4u);
  EXPECT_EQ(target.corners[1].position, Eigen::Vector3d(0, -0.105, 0.07425));
  for (const Eigen::Vector3d& position : {Eigen::Vector3d(-0.4, 0, 0), {-0.5, -0.2, 0.1}})
    EXPECT_LT(error_of_start(target, straight, position), 0.006) << position.transpose();
}

TEST(CutTarget, TakesDistortionFromTheCalibration) {
  const TestPhotograph photograph = photograph_from({-0.33, 0.08, 0.05}, distorted);
  TargetCut cut = cut_at(photograph.corners_px);
  cut.camera = distorted;
  const Target target = cut_as_read(cut_target(photograph.image, cut).target);
  EXPECT_LT(error_of_start(target, distorted, {-0.45, 0.1, 0.05}), 0.006);
}

TEST(CutTarget, ShowsTheRectangleFromTheFront) {
  const TestPhotograph photograph = photograph_from({-0.45, 0.25, 0.1}, straight);
  const CutTarget made = cut_target(photograph.image, cut_at(photograph.corners_px));
  const Image& picture = made.target.picture;
  EXPECT_EQ(std::max(picture.width(), picture.height()), 100);
  const NewTarget::Corner &upper_left = made.target.corners[0], &upper_right = made.target.corners[1];
  EXPECT_NEAR(upper_left.picture_px.y(), upper_right.picture_px.y(), 1e-9);
  EXPECT_NEAR((upper_right.picture_px.x() - upper_left.picture_px.x()) / width_m,
              (made.target.corners[3].picture_px.y() - upper_left.picture_px.y()) / height_m, 1e-6);
  // A quarter of the patch of an outer corner is black
  const Image& patch = upper_left.patch;
  EXPECT_GT(patch(2, 2), 200);
  EXPECT_GT(patch(12, 2), 200);
  EXPECT_LT(patch(12, 12), 50);
}

TEST(CutTarget, RefusalsSayWhatToDo) {
  const TestPhotograph photograph = photograph_from({-0.45, 0.1, 0.05}, straight);
  const auto refusal = [&](const std::function<void(TargetCut&)>& change) {
    TargetCut cut = cut_at(photograph.corners_px);
    change(cut);
    return message_of<std::invalid_argument>([&] { cut_target(photograph.image, cut); });
  };
  EXPECT_EQ(refusal([](TargetCut&) {}), "(none)");
  EXPECT_HAS(refusal([](TargetCut& c) {
               c.corners_px[2] = {700, 300};
             }),
             "corner 2 (lower right) at (700, 300): is outside of the photograph of 640x480 px");
  EXPECT_HAS(refusal([](TargetCut& c) { c.corners_px[0].x() = NAN; }), "corner 0 (upper left) at (nan");
  EXPECT_HAS(refusal([](TargetCut& c) { c.corners_px[0] = {3, 3}; }), "8 px or more from its border");
  EXPECT_HAS(refusal([](TargetCut& c) { std::swap(c.corners_px[1], c.corners_px[3]); }),
             "the corners are counterclockwise: give them clockwise: upper left");
  EXPECT_HAS(refusal([](TargetCut& c) { std::swap(c.corners_px[1], c.corners_px[2]); }),
             "no convex quadrilateral in this order");
  EXPECT_HAS(refusal([](TargetCut& c) { c.corners_px[1] += Eigen::Vector2d(-60, 20); }),
             "corner 1 (upper right) at (");
  EXPECT_HAS(refusal([](TargetCut& c) { c.corners_px[1] += Eigen::Vector2d(-60, 20); }),
             "no two edges meet within 4 px");
  EXPECT_HAS(refusal([](TargetCut& c) { std::swap(c.width_m, c.height_m), c.height_m *= 2; }),
             "is the size right (width x height)?");
  const TestPhotograph far = photograph_from({-3, 0.1, 0.05}, straight);
  EXPECT_HAS(message_of<std::invalid_argument>([&] { cut_target(far.image, cut_at(far.corners_px)); }),
             "photograph it from nearer");
}

}  // namespace
}  // namespace incognita
