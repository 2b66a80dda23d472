// Settings that follow from the image and the size of the map, and the map that gives up landmarks.
#include <gtest/gtest.h>

#include "incognita/slam/features/automatic_settings.hpp"
#include "incognita/slam/features/map_management.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

int wanted(int width, int height, int set = 0) {
  WideAngleCamera lens;
  lens.width = width, lens.height = height;
  CameraSlamSettings settings;
  settings.map.wanted_visible = set;
  return with_automatic(settings, lens).map.wanted_visible;
}

TEST(AutomaticSettings, FeaturesGrowWithTheImageWithinLimits) {
  EXPECT_EQ(wanted(640, 480), 60);
  EXPECT_EQ(wanted(320, 240), 30);
  EXPECT_EQ(wanted(160, 120), 30);
  EXPECT_EQ(wanted(1280, 720), 80);
  EXPECT_EQ(wanted(640, 480, 7), 7) << "as set";
}

TEST(AutomaticSettings, MoreLandmarksAreInViewWhereGapsAreFilled) {
  WideAngleCamera lens;
  lens.width = 320, lens.height = 240;
  CameraSlamSettings settings;
  settings.map.wanted_visible = 30;
  EXPECT_EQ(most_in_view(settings, lens), 30) << "without gaps to fill those that are searched for";
  settings.map.max_gap_m = 0.6;
  const int most = most_in_view(settings, lens);
  EXPECT_GT(most, 90);
  settings.map.max_gap_m = 0.3;
  EXPECT_NEAR(most_in_view(settings, lens), 4 * most, 4) << "by area";
  settings.initialization.inverse_depth_per_m *= 2;
  EXPECT_NEAR(most_in_view(settings, lens), most, 1) << "surfaces expected at half the distance";
  settings.map.max_gap_m = 1e-6;
  EXPECT_LE(most_in_view(settings, lens), 10000);
  settings.map.max_gap_m = 5;
  EXPECT_EQ(most_in_view(settings, lens), 30);
}

TEST(AutomaticSettings, FewerMeasurementsAreAffordableInALargeMap) {
  SearchSettings settings;
  settings.budget_ms = 20;
  EXPECT_GT(affordable_measurements(settings, 100), 100);
  EXPECT_LT(affordable_measurements(settings, 3000), affordable_measurements(settings, 1500));
  EXPECT_EQ(affordable_measurements(settings, 100000), 10) << "never none";
  settings.budget_ms = 40;
  EXPECT_NEAR(affordable_measurements(settings, 1500), 2 * affordable_measurements({}, 1500), 1);
}

/// Of landmarks out of view those with the fewest matches; never one in view.
TEST(FullMap, GivesUpTheLeastMatchedOutOfView) {
  Tracking t(origin, CameraCov(1e-6 * CameraCov::Identity()));
  const Wall wall(2);
  const Image image = wall.seen_from(origin);
  const auto corners = wall.corners_in_view(origin, 60);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d there =
        i == 0 ? corners[i] : Eigen::Vector3d(corners[i] + Eigen::Vector3d(0, 50, 0));
    const std::int64_t id = t.add_point(image, origin, corners[i], there, 0.01);
    t.landmark(id).detection_count = static_cast<int>(10 * i);
  }
  predict_matches(t.estimate, t.tracked);
  EXPECT_EQ(delete_least_matched(t.estimate, t.tracked, 2), 2);
  EXPECT_TRUE(t.estimate.landmarks.contains(0)) << "in view";
  EXPECT_TRUE(t.estimate.landmarks.contains(3)) << "matched most often";
  EXPECT_EQ(t.tracked.features.size(), 2u);
  EXPECT_EQ(delete_least_matched(t.estimate, t.tracked, 5), 1) << "no more than there are";
  EXPECT_EQ(delete_least_matched(t.estimate, t.tracked, 0), 0);
}

}  // namespace
}  // namespace incognita
