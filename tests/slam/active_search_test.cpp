// The active search (thesis C.2): the most uncertain landmarks first, each inside its own ellipse, and what
// the other matches do not confirm is left out.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "incognita/slam/features/active_search.hpp"
#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const Wall wall(2);
constexpr double px_per_m = 195 / 2.0;  // on the wall, seen from the origin

/// Landmarks at corners of the wall, spread over the image, all where they are believed to be but for `off`.
struct SearchScene : Tracking {
  Image image = wall.seen_from(origin);

  explicit SearchScene(double sigma_camera_m) : SearchScene(camera_covariance(sigma_camera_m)) {}
  explicit SearchScene(const CameraCov& P) : Tracking(origin, P) {
    tracked.settings.filter.sigma_pixel_px = 0.5;
  }
  static CameraCov camera_covariance(double sigma_m) {
    CameraCov P = 1e-8 * CameraCov::Identity();
    P.topLeftCorner<3, 3>() *= sigma_m * sigma_m / 1e-8;
    return P;
  }

  /// `off_px`: of the mean from the truth, in the image.
  Feature& add(std::size_t corner, double sigma_px, const Eigen::Vector2d& off_px = {0, 0}) {
    const Eigen::Vector3d at = wall.corners_in_view(origin, 40).at(corner);
    const Eigen::Vector3d off(0, -off_px.x() / px_per_m, -off_px.y() / px_per_m);
    return feature(add_point(image, origin, at, at + off, sigma_px / px_per_m));
  }

  SearchSettings& settings() { return tracked.settings.search; }
  /// Number of features searched for.
  int search() {
    const ImagePyramid pyramid(image, settings().levels);
    predict_matches(estimate, tracked);
    active_search(pyramid, tracked);
    return tracked.predicted;
  }
  /// Number of inliers.
  int reject() {
    reject_outliers(estimate, tracked);
    return tracked.matched;
  }
  const FeatureMatch& match_of(std::int64_t id) const {
    return *std::find_if(tracked.matches.begin(), tracked.matches.end(),
                         [id](const FeatureMatch& match) { return match.id == id; });
  }
  MatchOutcome outcome(std::int64_t id) const { return match_of(id).outcome; }
  Eigen::Vector2d truth(std::size_t corner) const {
    return pixel_of(origin, wall.corners_in_view(origin, 40).at(corner));
  }
};

TEST(ActiveSearch, TheMostUncertainFirstAndNoMoreThanAllowed) {
  SearchScene scene(1e-4);
  const double sigmas_px[] = {1, 5, 2, 6, 3, 4};
  for (std::size_t i = 0; i < 6; ++i) scene.add(9 * i, sigmas_px[i]);
  scene.settings().max_measurements = 3;
  EXPECT_EQ(scene.search(), 3);
  for (std::int64_t id = 0; id < 6; ++id)
    EXPECT_EQ(scene.outcome(id), sigmas_px[id] >= 4 ? MatchOutcome::matched : MatchOutcome::not_searched)
        << id;
  scene.settings().max_measurements = 12;
  EXPECT_EQ(scene.search(), 6);
  for (std::int64_t id = 0; id < 6; ++id) EXPECT_EQ(scene.outcome(id), MatchOutcome::matched) << id;
}

TEST(ActiveSearch, FeaturesThatStoppedMatchingComeLast) {
  SearchScene scene(1e-4);
  const double sigmas_px[] = {6, 5, 1, 2};
  for (std::size_t i = 0; i < 4; ++i) scene.add(9 * i, sigmas_px[i]);
  for (const std::int64_t id : {0, 1}) scene.feature(id).recent_attempts = 10;
  scene.settings().max_measurements = 2;
  EXPECT_EQ(scene.search(), 2);
  for (const std::int64_t id : {0, 1}) EXPECT_EQ(scene.outcome(id), MatchOutcome::not_searched) << id;
  for (const std::int64_t id : {2, 3}) EXPECT_EQ(scene.outcome(id), MatchOutcome::matched) << id;
}

TEST(ActiveSearch, AnchorsComeFirstUnlessTheyAreHidden) {
  for (const bool first : {false, true})
    for (const bool hidden : {false, true}) {
      SearchScene scene(1e-4);
      for (std::size_t i = 0; i < 3; ++i) scene.add(9 * i, 5);
      const Eigen::Vector3d at = wall.corners_in_view(origin, 40).at(30);
      const ImagePyramid pyramid(scene.image, 1);
      add_anchor(at, *cut_view(pyramid, scene.truth(30), origin, camera, scene.tracked.settings),
                 scene.estimate, scene.tracked);
      if (hidden) scene.feature(3).recent_attempts = 10;
      scene.settings().max_measurements = 2;
      scene.settings().anchors_first = first;
      EXPECT_EQ(scene.search(), 2);
      EXPECT_EQ(scene.outcome(3) == MatchOutcome::matched, first && !hidden) << first << hidden;
    }
}

TEST(ActiveSearch, FindsThePatchInsideItsEllipseAndNowhereElse) {
  constexpr double sigma_px = 4;  // with that of the pixel: 4.03
  const Eigen::Vector2d directions[] = {{1, 0}, {0, 1}, {-0.6, 0.8}};
  for (const Eigen::Vector2d& way : directions) {
    SearchScene inside(1e-5), outside(1e-5);
    inside.settings().min_correlation = outside.settings().min_correlation = 0.95;  // nothing alike
    inside.add(30, sigma_px, 10.5 * way);
    outside.add(30, sigma_px, 15 * way);
    inside.search();
    ASSERT_EQ(inside.outcome(0), MatchOutcome::matched) << way.transpose();
    // The patch in its own image: the peak of the correlation alone is wrong by up to 0.1 px
    EXPECT_LT((*inside.match_of(0).measured - inside.truth(30)).norm(), 0.02);
    outside.search();
    EXPECT_EQ(outside.outcome(0), MatchOutcome::not_found) << way.transpose();
    EXPECT_FALSE(outside.match_of(0).measured);
  }
}

/// Nearer than a pixel to its prediction: the smallest ellipse holds the nearest pixel.
/// Searched at an eighth of the resolution, where they are less than a pixel wide.
TEST(ActiveSearch, FindsPatchesInLongThinEllipses) {
  CameraCov P = SearchScene::camera_covariance(0);
  P.diagonal().head<3>().setConstant(1e-8);
  P(1, 1) = std::pow(17 / px_per_m, 2);
  for (const double moved_px : {-27.4, -18.6, 13.3, 22.7}) {
    SearchScene scene(P);
    scene.settings().levels = 4;
    for (std::size_t i = 0; i < 6; ++i) scene.add(5 * i, 0.1);
    const CameraState moved = camera_at({0, moved_px / px_per_m, 0});
    scene.image = wall.seen_from(moved);
    scene.search();
    for (std::size_t i = 0; i < 6; ++i) {
      const auto id = static_cast<std::int64_t>(i);
      ASSERT_EQ(scene.outcome(id), MatchOutcome::matched) << id << ", moved by " << moved_px << " px";
      const Eigen::Vector2d truth = pixel_of(moved, wall.corners_in_view(origin, 40).at(5 * i));
      EXPECT_LT((*scene.match_of(id).measured - truth).norm(), 0.6) << id;
    }
  }
}

TEST(ActiveSearch, OfACertainPredictionTriesTheNearestPixel) {
  for (const double off_px : {0.0, 0.3, 0.5}) {
    SearchScene scene(1e-5);
    scene.tracked.settings.filter.sigma_pixel_px = 0.01;
    scene.add(30, 0.01, {off_px, off_px});
    scene.search();
    ASSERT_EQ(scene.outcome(0), MatchOutcome::matched) << off_px;
    EXPECT_LT((*scene.match_of(0).measured - scene.truth(30)).norm(), 0.3);
  }
}

/// The best place of another scene: it is inside the ellipse, whatever it is like.
TEST(ActiveSearch, StaysInTheEllipseOfAnotherScene) {
  SearchScene scene(0.03);
  scene.settings().min_correlation = -1;
  for (std::size_t i = 0; i < 6; ++i) scene.add(9 * i, 3 + static_cast<double>(i));
  scene.image = Wall(2, 77).seen_from(origin);
  EXPECT_EQ(scene.search(), 6);
  for (const FeatureMatch& match : scene.tracked.matches) {
    ASSERT_TRUE(match.measured);
    const Eigen::Vector2d r = *match.measured - match.predicted;
    // The peak between the pixels may be half a pixel beyond
    const double reach = std::max(0.0, r.norm() - 0.75) / r.norm();
    EXPECT_LE(reach * reach * r.dot(match.innovation_cov.inverse() * r), 9);
  }
}

TEST(ActiveSearch, GoesNoFurtherOutThanTheLargestHalfAxis) {
  SearchScene scene(1e-5);
  scene.settings().max_half_axis_px = 8;
  scene.settings().min_correlation = 0.95;
  scene.add(30, 20, {10, 0});
  scene.search();
  EXPECT_EQ(scene.outcome(0), MatchOutcome::not_found);
  scene.settings().max_half_axis_px = 12;
  scene.search();
  EXPECT_EQ(scene.outcome(0), MatchOutcome::matched);
}

TEST(ActiveSearch, BelowTheLeastCorrelationNothingIsFound) {
  SearchScene scene(1e-5);
  scene.add(30, 2);
  scene.image = Wall(2, 77).seen_from(origin);
  EXPECT_EQ(scene.search(), 1) << "it was searched for";
  EXPECT_EQ(scene.outcome(0), MatchOutcome::not_found);
  EXPECT_FALSE(scene.match_of(0).measured);
  const double correlation = scene.match_of(0).correlation;
  EXPECT_LT(correlation, 0.8);
  scene.settings().min_correlation = correlation - 0.01;
  scene.search();
  EXPECT_EQ(scene.outcome(0), MatchOutcome::matched);
}

/// Five agree that the camera is where it is. One landmark is 12 px from where the map has it: far inside the
/// ellipse that the camera's uncertainty gives, far outside of what the five leave.
TEST(ActiveSearch, AnOutlierThatTheOthersContradictIsRejected) {
  SearchScene scene(0.05);  // 5 px each
  for (std::size_t i = 0; i < 5; ++i) scene.add(9 * i, 0.3);
  scene.add(45, 0.3, {12, 0});
  EXPECT_EQ(scene.search(), 6);
  EXPECT_EQ(scene.outcome(5), MatchOutcome::matched) << "by itself nothing speaks against it";
  EXPECT_EQ(scene.reject(), 5);
  EXPECT_EQ(scene.outcome(5), MatchOutcome::outlier);
  EXPECT_TRUE(scene.match_of(5).measured) << "what was found there stays on record";
  for (std::int64_t id = 0; id < 5; ++id) EXPECT_EQ(scene.outcome(id), MatchOutcome::matched) << id;
}

TEST(ActiveSearch, WithoutMatchesNothingIsLeft) {
  SearchScene scene(0.05);
  scene.add(30, 2);
  scene.image = Image(model.width, model.height, 90);
  scene.search();
  EXPECT_EQ(scene.reject(), 0);
  EXPECT_EQ(scene.outcome(0), MatchOutcome::not_found);
}

/// Recent landmarks fix the camera; one that returns after some frames is itself uncertain by 12 px, and no
/// other match says where it should be.
TEST(ActiveSearch, AReturningLandmarkThatNothingConfirmsIsAlone) {
  for (const int frames_away : {14, 15}) {
    SearchScene scene(0.02);
    for (std::size_t i = 0; i < 5; ++i) scene.add(9 * i, 0.3);
    scene.add(45, 12).frames_away = frames_away;
    scene.search();
    ASSERT_EQ(scene.outcome(5), MatchOutcome::matched);
    const bool returns = frames_away >= 15;
    EXPECT_EQ(scene.reject(), returns ? 5 : 6);
    EXPECT_EQ(scene.outcome(5), returns ? MatchOutcome::unconfirmed : MatchOutcome::matched) << frames_away;
  }
  SearchScene precise(0.02);
  for (std::size_t i = 0; i < 5; ++i) precise.add(9 * i, 0.3);
  precise.add(45, 6).frames_away = 100;
  precise.search();
  EXPECT_EQ(precise.reject(), 6) << "less uncertain than max_alone_sigma_px";
}

/// The camera itself is uncertain by much more than a pixel: two landmarks that return say the same of it.
TEST(ActiveSearch, ReturningLandmarksConfirmEachOther) {
  for (const std::size_t count : {1u, 2u}) {
    SearchScene scene(0.15);  // 15 px
    for (std::size_t i = 0; i < count; ++i) scene.add(9 + 27 * i, 0.3).frames_away = 40;
    scene.search();
    const int left = scene.reject();
    EXPECT_EQ(left, count == 1 ? 0 : 2);
    for (const FeatureMatch& match : scene.tracked.matches)
      EXPECT_EQ(match.outcome, count == 1 ? MatchOutcome::unconfirmed : MatchOutcome::matched);
  }
}

/// The second feature of a corner would count its information twice; the first counts, and no attempt for the second.
TEST(ActiveSearch, ACornerThatIsMappedTwiceIsMatchedOnce) {
  SearchScene s(0.001);
  s.add(0, 1), s.add(1, 1), s.add(0, 2);
  EXPECT_EQ(s.search(), 2);
  std::vector<MatchOutcome> outcomes;
  for (const auto& [id, feature] : s.tracked.features) outcomes.push_back(s.outcome(id));
  EXPECT_EQ(outcomes,
            (std::vector{MatchOutcome::matched, MatchOutcome::matched, MatchOutcome::not_searched}));
  EXPECT_FALSE(s.match_of(s.tracked.features.rbegin()->first).measured);
}

}  // namespace
}  // namespace incognita
