// Calibration from rendered chessboards of known cameras, and the refusal of views and of results that are of no use.
#include "incognita/vision/calibration/calibrate_camera.hpp"

#include <gtest/gtest.h>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/image_files.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/models/sensors/fisheye_camera.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "incognita/vision/calibration/guess_board.hpp"
#include "tests/scratch.hpp"
#include "tests/vision/rendered_board.hpp"

namespace incognita {
namespace {

using testing::BoardPhotographer;
using testing::BoardPlace;
using testing::careful_places;
using testing::Photograph;
using Settings = CalibrationSettings;

const BoardSize board{9, 6};
const PinholeCamera true_pinhole{320, 240, 260, 258, 163, 117.5, -0.25, 0.08, 0.001, -0.0005, 0};
const FisheyeCamera true_fisheye{320, 240, 140, 139.5, 161, 119, 0.02, -0.01, 0.003, -0.001};

const BoardPhotographer& with_pinhole() {
  static const BoardPhotographer photographer(true_pinhole, board);
  return photographer;
}

CalibrationViews careful_views(const BoardPhotographer& photographer, double focal, Photograph how = {},
                               int count = 14) {
  CalibrationViews views(board);
  for (const BoardPlace& place : careful_places(focal, count))
    views.add("view" + std::to_string(how.seed++), photographer.take(place, how));
  return views;
}

template <class TrueCamera>
void expect_camera(const LensFit& lens, const TrueCamera& camera) {
  const std::tuple<const char*, FittedValue, double> values[] = {{"fu", lens.fu, camera.fu},
                                                                 {"fv", lens.fv, camera.fv},
                                                                 {"u0", lens.u0, camera.u0},
                                                                 {"v0", lens.v0, camera.v0}};
  for (const auto& [name, fitted, truth] : values) {
    EXPECT_NEAR(fitted.value, truth, 0.003 * camera.fu) << name;
    EXPECT_NEAR(fitted.value, truth, 6 * fitted.sigma)
        << name;  // corners of rendered boards are off by more than noise
    EXPECT_LT(fitted.sigma, 0.002 * camera.fu) << name;
  }
}

TEST(Calibration, FindsTheRenderedPinhole) {
  CalibrationViews views = careful_views(with_pinhole(), 260.0 / 320);
  const CameraCalibration found = calibrate_camera(views, {});
  EXPECT_EQ(found.refusal, "");
  EXPECT_GE(views.used(), 10u);
  ASSERT_TRUE(found.lens);
  EXPECT_EQ(found.lens->model, LensModel::pinhole);
  expect_camera(*found.lens, true_pinhole);
  EXPECT_NEAR(found.lens->distortion[0].value, true_pinhole.k1, 0.01);
  EXPECT_EQ(found.lens->distortion[4].sigma, 0) << "k3 is not determined";
  EXPECT_LT(found.lens->rms_px, 0.15);
}

TEST(Calibration, FindsTheRenderedPinholeInBlurAndNoise) {
  CalibrationViews views = careful_views(with_pinhole(), 260.0 / 320, {.sigma_gray = 5, .blur_px = 1.5});
  const CameraCalibration found =
      calibrate_camera(views, {.model = Settings::Model::pinhole, .allow_third_radial = false});
  EXPECT_EQ(found.refusal, "");
  ASSERT_TRUE(found.lens);
  expect_camera(*found.lens, true_pinhole);
}

TEST(Calibration, FindsTheRenderedFisheyeAndItsModel) {
  CalibrationViews views = careful_views(BoardPhotographer(true_fisheye, board), 110.0 / 320, {}, 24);
  const CameraCalibration found = calibrate_camera(views, {});
  EXPECT_EQ(found.refusal, "");
  ASSERT_TRUE(found.lens);
  EXPECT_EQ(found.lens->model, LensModel::fisheye);
  expect_camera(*found.lens, true_fisheye);
}

/// Within half a percent of the published result, which has the corners of one view wrong by a pixel: docs/calibrate-a-camera.md.
TEST(Calibration, AgreesWithThePublishedResult) {
  std::filesystem::path folder;
  try {
    folder = find_data("chessboard_calibration", "", "test");
  } catch (const InputError& error) {
    GTEST_SKIP() << error.what();
  }
  const auto images = open_images({folder});
  const GuessedBoard guess = guess_board(*images);
  ASSERT_TRUE(guess.board);
  EXPECT_EQ(*guess.board, board);
  CalibrationViews views(*guess.board);
  images->rewind();
  while (const auto image = images->next()) views.add(image->name, image->image);
  EXPECT_EQ(views.used(), 13u);
  const CameraCalibration found = calibrate_camera(views, {});
  EXPECT_EQ(found.refusal, "");
  ASSERT_TRUE(found.lens);
  EXPECT_EQ(found.lens->model, LensModel::pinhole);
  const LensFit& lens = *found.lens;
  for (const auto& [value, published] : {std::pair{lens.fu.value, 535.91573396},
                                         {lens.fv.value, 535.91573396},
                                         {lens.u0.value, 342.28315473},
                                         {lens.v0.value, 235.57082910}})
    EXPECT_NEAR(value, published, 0.005 * published);
  EXPECT_LT(lens.rms_px, 0.3926) << "that of the published result";
}

// ------------------------------------------------------------------------------------------ standard deviations of parameters

/// Corners that a camera sees, with noise of 0.2 px: no image, so that many cameras can be calibrated.
template <class TrueCamera>
std::vector<std::vector<Eigen::Vector2d>> noisy_corners(const TrueCamera& camera, RandomStream& random) {
  std::vector<std::vector<Eigen::Vector2d>> views;
  for (const BoardPlace& place : careful_places(camera.fu / camera.width, 10)) {
    views.emplace_back();
    const Eigen::Matrix3d R = BoardPhotographer::camera_from_board(place);
    for (int row = 0; row < board.rows; ++row)
      for (int column = 0; column < board.columns; ++column) {
        const Eigen::Vector3d at(column - 4.0, row - 2.5, 0);
        views.back().push_back(camera.project(R * at + place.center).pixel +
                               0.2 * Eigen::Vector2d(random.normal(), random.normal()));
      }
  }
  return views;
}

/// Mean square of the errors of focal length and center over their standard deviations: 1 if these are right.
template <class TrueCamera>
double normalized_errors(const TrueCamera& camera, LensModel model) {
  RandomStream random(1, "corners");
  constexpr int cameras = 25;
  double sum = 0;
  for (int i = 0; i < cameras; ++i) {
    const LensFit lens =
        fit_lens(noisy_corners(camera, random), board, camera.width, camera.height, {model, false});
    EXPECT_EQ(lens.failure, "");
    // 1080 residuals less 68 parameters
    EXPECT_NEAR(lens.rms_px, 0.2 * std::sqrt(2 * 1012 / 1080.0), 0.025);
    for (const auto& [fitted, truth] :
         {std::pair{lens.fu, camera.fu}, {lens.fv, camera.fv}, {lens.u0, camera.u0}, {lens.v0, camera.v0}})
      sum += std::pow((fitted.value - truth) / fitted.sigma, 2) / (4 * cameras);
  }
  return sum;
}

/// 100 squares. If the errors of fu and fv are the same and all others independent, their mean is distributed as
/// (2 chi2(25) + chi2(50)) / 100, which is 0.6 to 1.5 with a probability of 99.1 %.
TEST(LensFit, StandardDeviationsAreThoseOfTheErrors) {
  const double pinhole = normalized_errors(true_pinhole, LensModel::pinhole);
  EXPECT_GT(pinhole, 0.6);
  EXPECT_LT(pinhole, 1.5);
  const double fisheye = normalized_errors(true_fisheye, LensModel::fisheye);
  EXPECT_GT(fisheye, 0.6);
  EXPECT_LT(fisheye, 1.5);
}

TEST(LensFit, ReportsWhereTheBoardsAre) {
  RandomStream random(1, "corners");
  const LensFit lens = fit_lens(noisy_corners(true_pinhole, random), board, 320, 240, {});
  const std::vector<BoardPlace> places = careful_places(260.0 / 320, 10);
  ASSERT_EQ(lens.boards.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(lens.boards[i].distance, places[i].center.norm(), 0.3);
    EXPECT_NEAR(std::cos(lens.boards[i].tilt_rad), BoardPhotographer::camera_from_board(places[i])(2, 2),
                0.02);
  }
}

// ------------------------------------------------------------------------------------------------------- refusals of views

const BoardPlace frontal{{0, 0, 13}, 0.3, 0.2, 0};

std::string refusal_of(const Image& image) {
  CalibrationViews views(board);
  return views.add("a", image).refusal;
}

TEST(CalibrationViews, TakeASharpBoard) { EXPECT_EQ(refusal_of(with_pinhole().take(frontal)), ""); }

TEST(CalibrationViews, RefuseABlurredBoard) {
  EXPECT_EQ(refusal_of(with_pinhole().take(frontal, {.blur_px = 1.5})), "");
  EXPECT_HAS(refusal_of(with_pinhole().take(frontal, {.blur_px = 3})),
             "blurred: the edges of its squares are ");
  EXPECT_HAS(refusal_of(with_pinhole().take(frontal, {.blur_px = 3})), "px wide, and may be 6.0");
}

TEST(CalibrationViews, RefuseImagesWithoutTheWholeBoard) {
  const std::string none = "no board with 9x6 inner corners: all of it must be in the image";
  EXPECT_HAS(refusal_of(Image(320, 240, 128)), none);
  EXPECT_HAS(refusal_of(with_pinhole().take({{5, 0, 13}, 0, 0, 0})), none);
  EXPECT_HAS(refusal_of(BoardPhotographer(true_pinhole, {8, 6}).take(frontal)), none);
  for (const int size : {1, 3, 20}) EXPECT_HAS(refusal_of(Image(size, size, 7)), none);
  Image noise(320, 240);
  RandomStream random(1, "noise");
  for (int i = 0; i < 320 * 240; ++i) noise.row(0)[i] = static_cast<std::uint8_t>(random.below(256));
  EXPECT_HAS(refusal_of(noise), none);
}

TEST(CalibrationViews, RefuseAnObliqueBoard) {
  EXPECT_HAS(refusal_of(with_pinhole().take({{0, 0, 14}, 0, 1.1, 0}, {.blur_px = 0.4})),
             "too oblique or too far: the shortest side of a square is ");
}

TEST(CalibrationViews, RefuseNearlyTheSameView) {
  CalibrationViews views(board);
  EXPECT_EQ(views.add("first", with_pinhole().take(frontal)).refusal, "");
  BoardPlace moved = frontal;
  moved.center.x() += 0.1;
  EXPECT_HAS(views.add("second", with_pinhole().take(moved)).refusal,
             "nearly the same as first: its corners are ");
  moved.turn = 3.14159265358979;  // upside down, and so with another first corner
  EXPECT_HAS(views.add("turned", with_pinhole().take(moved)).refusal, "nearly the same as first");
  moved.center.x() += 1;
  EXPECT_EQ(views.add("third", with_pinhole().take(moved)).refusal, "");
  EXPECT_EQ(views.used(), 2u);
}

TEST(CalibrationViews, RefuseAnotherSizeOfImages) {
  CalibrationViews views(board);
  views.add("first", with_pinhole().take(frontal));
  EXPECT_EQ(views.add("second", Image(640, 480)).refusal,
            "is 640x480 px, and the first image is 320x240: a calibration holds for one size of images");
  views.add_unreadable("third", "truncated");
  EXPECT_EQ(views.views().back().refusal, "truncated");
}

// ----------------------------------------------------------------------------------------------------- refusals of results

std::string refusal_of(const std::vector<BoardPlace>& places, const Photograph& how = {}) {
  CalibrationViews views(board);
  int number = 0;
  for (const BoardPlace& place : places)
    views.add("view" + std::to_string(number++), with_pinhole().take(place, how));
  return calibrate_camera(views, {}).refusal;
}

TEST(Calibration, OfOneViewIsRefused) {
  EXPECT_HAS(refusal_of({frontal}),
             "one view does not determine a focal length: it trades against the distance of the board");
}

TEST(Calibration, OfFewViewsIsRefused) {
  EXPECT_HAS(refusal_of({frontal, frontal, {{1, 0, 13}, 0.3, -0.2, 0}}),
             "2 of 3 images can be used, and 5 are needed");
}

TEST(Calibration, OfBlurredViewsIsRefused) {
  EXPECT_EQ(refusal_of(careful_places(260.0 / 320, 8), {.blur_px = 3.5}),
            "no view of the 9x6 board can be used");
}

/// From views that are all parallel to the image only the ratio of focal length and distance follows.
TEST(Calibration, OfParallelViewsIsRefused) {
  std::vector<BoardPlace> places;
  for (int i = 0; i < 8; ++i)
    places.push_back({{2.0 * (i % 4) - 3, 2.0 * (i / 4) - 1, 14.0 + i}, 0, 0, 0.1 * i});
  const std::string refusal = refusal_of(places);
  EXPECT_HAS(refusal, "the views do not determine the focal length: fu = ");
  EXPECT_HAS(refusal, "add views in which the board is tilted by 20 to 45 degrees");
}

TEST(Calibration, OfOnePartOfTheImageIsRefused) {
  std::vector<BoardPlace> places;
  for (int i = 0; i < 9; ++i)
    places.push_back(
        {{-5.6 - 0.5 * (i % 3), -3.4 - 0.5 * (i / 3), 20}, 0.4 * (i % 3 - 1), 0.4 * (i / 3 - 1), 0});
  const std::string refusal = refusal_of(places, {.blur_px = 0.4});
  EXPECT_HAS(refusal, " % of the image, and must cover 40 %");
  EXPECT_HAS(refusal, "Move the board to: ");
  EXPECT_HAS(refusal, "lower right");
}

/// The last two places are near the first two: as in a video, where the camera moves slowly.
TEST(Calibration, UsesTheViewsThatDifferMost) {
  CalibrationViews views(board);
  std::vector<BoardPlace> places = {{{-3, -2, 16}, 0.4, 0.4, 0}, {{3, 2, 16}, 0.4, -0.4, 0},
                                    {{-3, 2, 16}, -0.4, 0.4, 0}, {{3, -2, 16}, -0.4, -0.4, 0},
                                    {{0, 0, 13}, 0, 0.5, 0},     {{-3.4, -2, 16}, 0.4, 0.4, 0},
                                    {{3.4, 2, 16}, 0.4, -0.4, 0}};
  for (const BoardPlace& place : places) views.add("view", with_pinhole().take(place));
  ASSERT_EQ(views.used(), 7u);
  EXPECT_EQ(calibrate_camera(views, {.most_views = 5}).refusal, "");
  EXPECT_EQ(views.used(), 5u);
  for (const std::size_t one : {0, 1})
    EXPECT_NE(views.views()[one].refusal.empty(), views.views()[one + 5].refusal.empty())
        << "one of each pair";
  EXPECT_TRUE(views.views()[2].refusal.empty());
}

/// One board is a print that is 6 % wider than high.
TEST(Calibration, RefusesAnOutlier) {
  CalibrationViews views = careful_views(with_pinhole(), 260.0 / 320);
  views.add("stretched", with_pinhole().take({{1, -1, 14}, -0.4, 0.3, 0.1}, {.stretch = 1.06}));
  ASSERT_EQ(views.views().back().refusal, "");
  const CameraCalibration found = calibrate_camera(views, {});
  EXPECT_EQ(found.refusal, "");
  EXPECT_HAS(views.views().back().refusal, "outlier: its corners are off by ");
  EXPECT_TRUE(std::isnan(found.view_rms_px.back()));
  expect_camera(*found.lens, true_pinhole);
}

// --------------------------------------------------------------------------------------------------------------- the board

class Pictures final : public ImageSource {
 public:
  explicit Pictures(std::vector<Image> images) : images_(std::move(images)) {}
  std::optional<SourceImage> next() override {
    if (next_ >= images_.size()) return std::nullopt;
    const std::size_t i = next_++;
    return SourceImage{"image" + std::to_string(i), images_[i], images_[i].width() == 1 ? "damaged" : ""};
  }
  void skip() override { ++next_; }
  void rewind() override { next_ = 0; }
  std::size_t count() const override { return images_.size(); }

 private:
  std::vector<Image> images_;
  std::size_t next_ = 0;
};

TEST(GuessedBoard, IsTheOneThatMostImagesShow) {
  const BoardPhotographer other(true_pinhole, {7, 5});
  Pictures pictures({Image(1, 1), Image(320, 240, 90), with_pinhole().take(frontal), other.take(frontal),
                     other.take({{1, 0, 13}, 0, 0.3, 0})});
  const GuessedBoard guess = guess_board(pictures);
  ASSERT_TRUE(guess.board);
  EXPECT_EQ(guess.board->text(), "7x5");
  EXPECT_EQ(guess.shown, 2u);
  EXPECT_EQ(guess.tried, 4u);
  EXPECT_EQ(guess.example, "image3");
}

TEST(GuessedBoard, IsNoneWithoutBoards) {
  Pictures pictures({Image(320, 240, 90), Image(4, 4)});
  EXPECT_FALSE(guess_board(pictures).board);
  EXPECT_FALSE(most_frequent({}));
}

/// A Gaussian edge rises from 10 to 90 % over 2.56 standard deviations. Pixels of the photograph and their interpolation blur by about
/// 0.4 px more.
TEST(EdgeWidth, IsThatOfTheBlur) {
  for (const double blur_px : {0.7, 1.5, 2.5}) {
    const auto found = find_chessboard(with_pinhole().take(frontal, {.blur_px = blur_px}), board);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->edge_width_px, 2.56 * std::hypot(blur_px, 0.4), 0.35) << blur_px;
  }
}

TEST(BoardSize, IsReadFromText) {
  EXPECT_EQ(parse_board("9x6"), (BoardSize{9, 6}));
  EXPECT_TRUE((BoardSize{6, 9}.is_like({9, 6})));
  for (const char* text : {"", "9", "9x", "x6", "9x6 ", "9*6", "2x6", "9x51", "-9x6", "99999999999x6"})
    EXPECT_FALSE(parse_board(text)) << text;
}

TEST(Coverage, NamesTheEmptyParts) {
  Coverage coverage(80, 60);
  EXPECT_EQ(coverage.share(), 0);
  std::vector<Eigen::Vector2d> all_but_right;
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 5; ++u) all_but_right.emplace_back(10 * u + 5, 10 * v + 5);
  coverage.add(all_but_right);
  coverage.add({{-0.4, -0.4}, {79.4, 59.4}});
  EXPECT_EQ(coverage.count(0, 0), 2);
  EXPECT_EQ(coverage.count(5, 7), 1);
  EXPECT_NEAR(coverage.share(), 31.0 / 48, 1e-12);
  EXPECT_EQ(coverage.gaps(), "upper right, right, lower right");
  EXPECT_HAS(coverage.grid(), "    2    1    1    1    1    .    .    .\n");
}

}  // namespace
}  // namespace incognita
