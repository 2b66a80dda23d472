// Which corners of an image become landmarks: none near another, none about to leave the view, none where
// nothing is to be seen (thesis C.4).
#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const CameraCov well_known = 1e-6 * CameraCov::Identity();

/// What `times` draws choose, nothing being added to the map.
std::vector<Eigen::Vector2d> chosen(const Image& image, const Tracking& t, int times,
                                    std::uint64_t seed = 1) {
  RandomStream random(seed, "test");
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < times; ++i)
    if (const auto corner = find_new_corner(image, t.estimate, t.tracked, random)) corners.push_back(*corner);
  return corners;
}

/// Gray, but for a dark square whose first pixel is (u, v).
Image one_square(double u, double v, int side) {
  Image image(model.width, model.height, 160);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) image(static_cast<int>(u) + x, static_cast<int>(v) + y) = 40;
  return image;
}

TEST(CornerChoice, NoneInFlatImages) {
  Tracking t(origin, well_known);
  EXPECT_TRUE(chosen(Image(model.width, model.height, 128), t, 20).empty());

  Image noisy(model.width, model.height);
  RandomStream random(2, "noise");
  for (int v = 0; v < model.height; ++v)
    for (int u = 0; u < model.width; ++u)
      noisy(u, v) = static_cast<std::uint8_t>(std::lround(128 + 2 * random.normal()));
  EXPECT_TRUE(chosen(noisy, t, 20).empty()) << "weaker than min_corner_strength";
  t.tracked.settings.initialization.min_corner_strength = 0.1;
  EXPECT_FALSE(chosen(noisy, t, 20).empty()) << "it is the strength that decides";
}

TEST(CornerChoice, NoneInImagesSmallerThanAPatchAndItsMargin) {
  const Tracking t(origin, well_known);
  for (const int side : {1, 5, 20}) EXPECT_TRUE(chosen(Image(side, side, 128), t, 20).empty()) << side;
}

TEST(CornerChoice, IsWhereTheEdgesMeet) {
  const auto corners = chosen(one_square(150, 110, 60), Tracking(origin, well_known), 30);
  ASSERT_FALSE(corners.empty());
  for (const Eigen::Vector2d& at : corners) {
    // Between the pixels 149 and 150 of one side, 209 and 210 of the other
    EXPECT_LT(std::min(std::abs(at.x() - 149.5), std::abs(at.x() - 209.5)), 0.3) << at.transpose();
    EXPECT_LT(std::min(std::abs(at.y() - 109.5), std::abs(at.y() - 169.5)), 0.3) << at.transpose();
  }
}

/// A small square: all its corners are within the box that a landmark in its middle keeps free.
TEST(CornerChoice, NoneNearAFeatureThatIsExpected) {
  const Image image = one_square(156, 116, 8);
  const Eigen::Vector2d middle(160, 120);
  const Tracking empty(origin, well_known);
  ASSERT_FALSE(chosen(image, empty, 20).empty());

  for (const auto method :
       {InitializationSettings::Method::inverse_depth, InitializationSettings::Method::depth_line}) {
    Tracking begun = empty;
    begun.tracked.settings.initialization.method = method;
    ASSERT_TRUE(begun.initialize(image, middle));
    EXPECT_TRUE(chosen(image, begun, 60).empty()) << "begun in this very frame, or a line";
  }
  Tracking searched = empty;
  const Eigen::Vector3d at = Wall(2).point_at(origin, middle);
  searched.feature(searched.add_point(image, origin, at, at, 0.01)).attempts = 5;
  EXPECT_FALSE(chosen(image, searched, 20).empty()) << "not expected to be seen in this frame";
  predict_matches(searched.estimate, searched.tracked);
  ASSERT_EQ(searched.tracked.matches.size(), 1u);
  EXPECT_TRUE(chosen(image, searched, 60).empty());
  searched.tracked.matches[0].measured = middle + Eigen::Vector2d(100, 40);
  EXPECT_FALSE(chosen(image, searched, 20).empty()) << "where it was found counts";
}

TEST(CornerChoice, UntilTheImageIsFullKeepsFeaturesApart) {
  CameraSlamSettings settings = few_features();
  settings.initialization.box_width_px = settings.initialization.box_height_px = 24;
  Tracking t(origin, well_known, settings);
  const Image image = Wall(2).seen_from(origin);
  RandomStream random(1, "test");
  std::vector<Eigen::Vector2d> taken;
  while (const auto corner = find_new_corner(image, t.estimate, t.tracked, random)) {
    ASSERT_LT(taken.size(), 400u);
    for (const Eigen::Vector2d& other : taken)
      EXPECT_GE((*corner - other).lpNorm<Eigen::Infinity>(), settings.search.patch_size_px / 2)
          << corner->transpose() << " beside " << other.transpose();
    taken.push_back(*corner);
    ASSERT_TRUE(t.initialize(image, *corner));
  }
  EXPECT_GT(taken.size(), 15u);
}

/// Around a landmark at 2 m on a wall, as much as half of the gap is kept free, whatever the image shows there.
TEST(CornerChoice, GapsAreFilledByDistance) {
  const Image image = Wall(2).seen_from(origin);
  const Eigen::Vector2d middle(160, 120);
  for (const double gap_m : {0.4, 0.8}) {
    Tracking t(origin, well_known);
    t.tracked.settings.initialization.look_ahead_s = 0;
    t.tracked.median_depth_m = 2;
    const Eigen::Vector3d known = Wall(2).point_at(origin, middle);
    t.add_point(image, origin, known, known, 0.01);
    std::vector<Eigen::Vector3d> covered = {known};
    double nearest = 10;
    for (const Eigen::Vector2d& at : find_new_corners(image, t.estimate, t.tracked, 1000, 0, gap_m)) {
      const Eigen::Vector3d on_wall = Wall(2).point_at(origin, at);
      for (const Eigen::Vector3d& other : covered) nearest = std::min(nearest, (on_wall - other).norm());
      covered.push_back(on_wall);
    }
    EXPECT_GT(nearest, 0.45 * gap_m) << "half of it, but for the slant of the wall";
    EXPECT_LT(nearest, 0.75 * gap_m);
    EXPECT_GT(covered.size(), 5u);
  }
}

TEST(CornerChoice, ALandmarkCoversWhatIsAroundItAtItsDistance) {
  const Eigen::Vector3d ahead(0, 0, 1), landmark(0.25, 0, 3);
  EXPECT_FALSE(is_covered(ahead, {}, 1));
  EXPECT_TRUE(is_covered(ahead, {&landmark, 1}, 0.6)) << "0.25 m beside it";
  EXPECT_TRUE(is_covered(7 * ahead, {&landmark, 1}, 0.6)) << "of the ray only the direction counts";
  EXPECT_FALSE(is_covered(ahead, {&landmark, 1}, 0.4));
  const Eigen::Vector3d nearer = landmark / 2;
  EXPECT_TRUE(is_covered(ahead, {&nearer, 1}, 0.4)) << "the same direction, but 0.13 m beside it";
  EXPECT_FALSE(is_covered(-ahead, {&nearer, 1}, 0.4));
}

/// Share of corners that will be out of the image in `look_ahead_s`, were they `depth_m` away.
double share_leaving(const std::vector<Eigen::Vector2d>& corners, const CameraState& now, double depth_m,
                     double look_ahead_s) {
  CameraState later = now;
  later.head<3>() += look_ahead_s * free_camera::velocity(now);
  later.segment<4>(3) = quaternion_product<double>(
      free_camera::orientation(now),
      quaternion_exp<double>(Eigen::Vector3d(look_ahead_s * free_camera::angular_rate(now))));
  int leaving = 0;
  for (const Eigen::Vector2d& at : corners) {
    const Eigen::Vector3d point =
        free_camera::position(now) +
        rotation_matrix<double>(free_camera::orientation(now)) * camera.unproject(at)->normalized() * depth_m;
    const auto projected = camera.project(PointLandmark::in_camera<double>(later, point));
    leaving += !projected || !camera.contains(projected->pixel);
  }
  return static_cast<double>(leaving) / static_cast<double>(corners.size());
}

TEST(CornerChoice, NoneThatIsAboutToLeaveTheView) {
  CameraSlamSettings settings = few_features();
  settings.initialization.look_ahead_s = 0.5;
  const Image image = Wall(2).seen_from(origin);
  CameraState turning = origin, sliding = origin;
  turning[11] = 0.8;  // rad/s about camera y: what is at the left leaves
  sliding[8] = 0.6;   // m/s to the left: what is near, at the right, leaves
  for (const CameraState& now : {turning, sliding}) {
    const auto kept = chosen(image, Tracking(now, well_known, settings), 150);
    ASSERT_GT(kept.size(), 50u);
    for (const double depth_m :
         {settings.initialization.min_depth_m, 1.0, settings.initialization.max_depth_m})
      EXPECT_EQ(share_leaving(kept, now, depth_m, 0.5), 0) << depth_m;
    settings.initialization.look_ahead_s = 0;
    EXPECT_GT(share_leaving(chosen(image, Tracking(now, well_known, settings), 150), now,
                            settings.initialization.min_depth_m, 0.5),
              0)
        << "were it not for the look ahead";
    settings.initialization.look_ahead_s = 0.5;
  }
}

TEST(CornerChoice, SameRandomStreamSameCorners) {
  const Image image = Wall(2).seen_from(origin);
  const Tracking t(origin, well_known);
  EXPECT_EQ(chosen(image, t, 10, 7), chosen(image, t, 10, 7));
  EXPECT_NE(chosen(image, t, 10, 7), chosen(image, t, 10, 8));
}

}  // namespace
}  // namespace incognita
