// A calibration while images come: which of them become views, and that the camera is found.
#include "incognita/vision/calibration/live_calibration.hpp"

#include <gtest/gtest.h>

#include "incognita/models/sensors/pinhole_camera.hpp"
#include "tests/scratch.hpp"
#include "tests/vision/rendered_board.hpp"

namespace incognita {
namespace {

using testing::BoardPhotographer;
using testing::BoardPlace;

const BoardSize board{9, 6};
const PinholeCamera true_camera{320, 240, 260, 258, 163, 117.5, -0.25, 0.08, 0.001, -0.0005, 0};
const BoardPlace frontal{{0, 0, 14}, 0.2, 0.1, 0};

const BoardPhotographer& photographer() {
  static const BoardPhotographer one(true_camera, board);
  return one;
}

/// A camera of ten images per second.
struct Operator {
  LiveCalibration live;
  double t = 0;

  explicit Operator(std::optional<BoardSize> given = board) : live(LiveCalibrationSettings{given}) {}
  const std::string& show(const Image& image) {
    live.add(t += 0.1, image);
    return live.newest().refusal;
  }
  const std::string& show(const BoardPlace& place) { return show(photographer().take(place)); }
  void hold(const BoardPlace& place) {
    show(place);
    show(place);
  }
  std::size_t used() const { return live.views() ? live.views()->used() : 0; }
};

TEST(LiveCalibration, FindsTheCameraFromBoardsHeldStill) {
  Operator one;
  for (const BoardPlace& place : testing::careful_places(260.0 / 320, 12)) one.hold(place);
  EXPECT_EQ(one.live.calibration().refusal, "");
  EXPECT_GE(one.used(), 9u);
  ASSERT_TRUE(one.live.calibration().lens);
  EXPECT_NEAR(one.live.calibration().lens->fu.value, true_camera.fu, 0.005 * true_camera.fu);
  EXPECT_NEAR(one.live.calibration().lens->u0.value, true_camera.u0, 0.005 * 320);
}

TEST(LiveCalibration, TakesABoardOnlyWhileItIsStill) {
  Operator one;
  EXPECT_EQ(one.show(frontal), "hold the board still");
  BoardPlace moving = frontal;
  for (int i = 0; i < 5; ++i) {
    moving.center.x() += 0.12;  // 2 px at this distance: 20 px/s of 320 px
    EXPECT_HAS(one.show(moving), "moves: hold the board still (its corners move by ");
  }
  EXPECT_EQ(one.used(), 0u);
  EXPECT_EQ(one.show(moving), "");
  EXPECT_EQ(one.used(), 1u);
}

TEST(LiveCalibration, ForgetsTheSpeedWhenTheBoardIsAwayOrImagesAreMissing) {
  Operator one;
  one.show(frontal);
  one.show(Image(320, 240, 128));
  EXPECT_EQ(one.show(frontal), "hold the board still");
  one.t += 2;
  EXPECT_EQ(one.show(frontal), "hold the board still");
  EXPECT_EQ(one.show(frontal), "");
}

TEST(LiveCalibration, SaysWhyAnImageIsNoView) {
  Operator one;
  EXPECT_HAS(one.show(Image(320, 240, 128)), "no board with 9x6 inner corners");
  one.hold(frontal);
  EXPECT_HAS(one.show(frontal), "nearly the same as view 1");
  EXPECT_FALSE(one.live.newest().corners.empty());
  EXPECT_HAS(one.show(photographer().take(frontal, {.blur_px = 3})), "blurred");
  EXPECT_HAS(one.live.calibration().refusal, "one view does not determine a focal length");
}

TEST(LiveCalibration, KeepsNoRefusedImage) {
  Operator one;
  for (int i = 0; i < 30; ++i) one.show(frontal);
  EXPECT_EQ(one.live.images(), 30u);
  EXPECT_EQ(one.live.views()->views().size(), 1u);
}

TEST(LiveCalibration, GuessesTheBoardAndStartsAgain) {
  Operator one(std::nullopt);
  EXPECT_HAS(one.show(Image(320, 240, 128)), "no board: all of it must be in the image");
  EXPECT_HAS(one.show(frontal), "a board of 9x6 inner corners: keep it in the image");
  EXPECT_EQ(one.live.views(), std::nullopt);
  for (int i = 0; i < 4; ++i) one.show(frontal);
  ASSERT_TRUE(one.live.views());
  EXPECT_TRUE(one.live.views()->board().is_like(board));
  EXPECT_EQ(one.used(), 1u);
  one.live.restart();
  EXPECT_EQ(one.live.views(), std::nullopt);
  EXPECT_EQ(one.live.calibration().refusal, "no view yet");
}

TEST(LiveCalibration, TheFirstViewDeterminesTheSizeAndNotTheFirstImage) {
  Operator one;
  one.show(Image(240, 320, 128));
  one.hold(frontal);
  EXPECT_EQ(one.used(), 1u);
}

/// All in the middle: the coverage stays too small.
TEST(LiveCalibration, TakesMoreViewsIfTheyDoNotDetermineTheCamera) {
  Operator one;
  RandomStream random(4, "middle");
  for (int i = 0; i < 200 && one.used() < LiveCalibration::most_views + 2; ++i)
    one.hold({{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(28, 32)},
              random.uniform(-0.5, 0.5),
              random.uniform(-0.5, 0.5),
              random.uniform(-1, 1)});
  EXPECT_HAS(one.live.calibration().refusal, "the boards cover ");
  EXPECT_EQ(one.used(), LiveCalibration::most_views + 2);
}

TEST(LiveCalibration, AfterARestartTakesImagesOfAnotherSize) {
  Operator one;
  one.hold(frontal);
  EXPECT_HAS(one.show(Image(240, 320, 128)), "a calibration holds for one size of images");
  one.live.restart();
  EXPECT_HAS(one.show(Image(240, 320, 128)), "no board with 9x6 inner corners");
  EXPECT_EQ(one.used(), 0u);
}

TEST(LiveCalibration, EndsAtEnoughViewsAllOfWhichAreFitted) {
  Operator one;
  std::size_t fitted = 0;
  for (const BoardPlace& place : testing::careful_places(260.0 / 320, 60)) {
    one.hold(place);
    if (one.used() == 13) {  // the last three have no residuals yet
      EXPECT_EQ(one.live.calibration().boards.size(), one.live.views()->views().size());
      one.live.finish();
      for (const double rms_px : one.live.calibration().view_rms_px) fitted += rms_px > 0;
      EXPECT_EQ(fitted, one.used());
    }
  }
  EXPECT_GT(fitted, 0u);
  EXPECT_EQ(one.live.views()->views().size(), LiveCalibration::most_views);
  EXPECT_HAS(one.show(frontal), "30 views are enough: finish, or start again");
}

}  // namespace
}  // namespace incognita
