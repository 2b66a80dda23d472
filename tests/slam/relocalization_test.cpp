// A lost camera that was carried away finds itself in the whole map, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/features/recognition.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita {
namespace {

using namespace synthetic;

CameraSlamSettings defaults() {
  CameraSlamSettings settings = few_features();
  settings.filter.sigma_pixel_px = 0.5;
  settings.filter.sigma_acceleration_m_s2 = 2;
  return settings;
}

/// A camera that slid along a wall by `way_m` to the left and `back_m` back, 2 cm a frame, and was lost under a covered lens.
struct Lost {
  Wall wall;
  SlamEstimator estimator;
  Estimate estimate;
  CameraState truth = camera_at({0, 0, 0});
  int k = 0;

  explicit Lost(const Wall& mapped, double way_m = 1.2, const CameraSlamSettings& s = defaults(),
                double back_m = 0)
      : wall(mapped), estimator(single_camera(camera, sheet_target(), s, 10, 1)) {
    for (int i = 0; i <= std::lround(way_m / 0.02); ++i) see(camera_at({0, 0.02 * i, 0}));
    for (int i = 1; i <= std::lround(back_m / 0.02); ++i) see(camera_at({0, way_m - 0.02 * i, 0}));
    EXPECT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
    EXPECT_LT(error_m(), 0.03);
    for (int i = 0; i < s.health.max_ticks; ++i) estimator.update(estimate, {}, seeing_gray(8), tick(k++));
    EXPECT_EQ(estimate.status.state, TrackingState::lost);
  }
  void see(const CameraState& from) { see(wall, from); }
  void see(const Wall& seen, const CameraState& from) {
    truth = from;
    estimator.update(estimate, {}, seeing(seen.shared_view(from)), tick(k++));
  }
  bool is_lost() const { return estimate.status.state == TrackingState::lost; }
  double error_m() const { return camera_error(truth, estimate.camera_state()).head<3>().norm(); }
  /// Frames until it is back; 100: it is not.
  int frames_until_back(const CameraState& from, int most = 10) {
    for (int i = 1; i <= most; ++i) {
      see(from);
      if (!is_lost()) return i;
    }
    return 100;
  }
};

const CameraState far_back = camera_at({0.1, 0.15, 0.05}, 0.15, {0, 0, 0.3});  // 1 m away and rolled

TEST(Relocalization, FindsACameraThatWasCarriedAway) {
  Lost lost(wall_with_sheet());
  const int frames = lost.frames_until_back(far_back);
  ASSERT_LE(frames, 10) << lost.estimate.status.reason;
  EXPECT_GE(frames, 3) << "confirmed by consecutive frames";
  EXPECT_EQ(lost.estimate.status.state, TrackingState::relocated);
  EXPECT_GE(lost.estimate.last.matched, 8);
  const Eigen::Matrix<double, 6, 1> e = camera_error(lost.truth, lost.estimate.camera_state()).head<6>();
  EXPECT_LT(e.head<3>().norm(), 0.05);
  EXPECT_LT(e.tail<3>().norm(), 0.03);
  const Eigen::Matrix<double, 6, 6> P = lost.estimate.body().pose_covariance;
  EXPECT_LT(e.dot(P.llt().solve(e)), 30) << "6 degrees of freedom";
  for (int i = 0; i < 10; ++i) {
    lost.see(far_back);
    ASSERT_EQ(lost.estimate.status.state, TrackingState::tracking) << lost.estimate.status.reason;
  }
  EXPECT_LT(lost.error_m(), 0.05);
}

TEST(Relocalization, GivesTheSameBytesAgain) {
  Lost one(wall_with_sheet()), other(wall_with_sheet());
  EXPECT_EQ(one.frames_until_back(far_back), other.frames_until_back(far_back));
  EXPECT_EQ(one.estimate.camera_state(), other.estimate.camera_state());
  EXPECT_EQ(one.estimate.belief.dense_covariance(), other.estimate.belief.dense_covariance());
}

TEST(Relocalization, IsASetting) {
  CameraSlamSettings off = defaults();
  off.relocalization.whole_map = off.relocalization.close_loops = false;
  Lost lost(wall_with_sheet(), 1.2, off);
  EXPECT_EQ(lost.frames_until_back(far_back), 100);
  for (const auto& [id, feature] : lost.estimator.cameras()[0].camera().features)
    EXPECT_TRUE(feature.described.empty());
}

TEST(Relocalization, ChangesNothingWhileTracking) {
  CameraSlamSettings off = defaults();
  off.relocalization.whole_map = false;
  Lost with(wall_with_sheet()), without(wall_with_sheet(), 1.2, off);
  EXPECT_EQ(with.estimate.camera_state(), without.estimate.camera_state());
  EXPECT_EQ(with.estimate.belief.dense_covariance(), without.estimate.belief.dense_covariance());
}

TEST(Relocalization, NotInAnUnknownPlace) {
  Lost lost(wall_with_sheet());
  const CameraState there = lost.estimate.camera_state();
  const Eigen::MatrixXd P = lost.estimate.belief.dense_covariance();
  for (std::uint64_t seed = 50; seed < 60; ++seed) {
    lost.see(Wall(1.4, seed), far_back);
    ASSERT_TRUE(lost.is_lost()) << seed;
  }
  EXPECT_EQ(lost.estimate.camera_state(), there) << "an attempt leaves no trace";
  EXPECT_EQ(lost.estimate.belief.dense_covariance(), P);
}

/// Without descriptors, as of landmarks from a saved map, it stays lost; with random ones, too.
TEST(Relocalization, NotByMissingOrRandomDescriptors) {
  for (const bool random : {false, true}) {
    Lost lost(wall_with_sheet());
    RandomStream bits(1, "descriptors");
    auto features = lost.estimator.cameras()[0].camera().features;
    for (auto& [id, feature] : features) {
      if (!random) feature.described.clear();
      for (DescribedView& view : feature.described)
        for (auto& at : view.descriptors) {
          for (auto& bin : at.descriptor.bins) bin = static_cast<std::uint8_t>(bits.below(90));
          at.descriptor.angle_rad = bits.uniform(0, 6.28);
        }
      lost.estimator.camera(0).adopt(id, feature);
    }
    EXPECT_EQ(lost.frames_until_back(far_back, 5), 100) << random;
  }
}

/// Landmarks that are not where the map has them, by more than a match is off but within the gate of each, as of a wall
/// that was mapped twice: the pose would be a mixture, and worse than its covariance says.
TEST(Relocalization, NotIfTheMatchesContradictTheMap) {
  constexpr double depth_m = 1.4;
  for (const double off_px : {0.2, 2.0}) {
    Lost lost(wall_with_sheet());
    RandomStream random(1, "displaced landmarks");
    for (const auto& [id, landmark] : lost.estimate.landmarks) {
      if (!landmark.mapped()) continue;
      const double way = random.uniform(0, 6.28), m = off_px * depth_m / model.fu;
      SmallVector y = lost.estimate.belief.mean(landmark.block);
      y.head<3>() += m * Eigen::Vector3d(0, std::cos(way), std::sin(way));
      lost.estimate.belief.set_mean(landmark.block, y);
    }
    EXPECT_EQ(lost.frames_until_back(far_back) == 100, off_px > 1) << off_px << " px";
  }
}

/// A wall that repeats itself every 1.92 m: poses a period apart explain an image about equally well. None of these is
/// within the search around the last pose, at 3.2 m, which assumes that the camera was not carried away.
TEST(Relocalization, NotAtTheWrongPeriodOfARepeatedTexture) {
  Wall repeated(1.4, 1, 0.03);
  repeated.hang_sheet(sheet_half_width_m, sheet_half_height_m, 0.1);
  for (const double y : {0.4, 2.2}) {
    Lost lost(repeated, 3.2);
    for (int i = 0; i < 6; ++i) {
      lost.see(camera_at({0.05, y, 0}, 0.1));
      EXPECT_TRUE(lost.is_lost() || lost.error_m() < 0.1) << y << ": " << lost.error_m() << " m off";
    }
  }
}

/// The same wall, from which the camera was carried by just one period: the search around its last pose finds everything.
TEST(Relocalization, NotAtItsLastPoseIfARepeatedTextureIsSeenElsewhereToo) {
  Wall repeated(1.4, 1, 0.03);
  repeated.hang_sheet(sheet_half_width_m, sheet_half_height_m, 0.1);
  Lost lost(repeated, 3.2);
  const CameraState there = camera_at({0, 3.2 - 1.92, 0});
  for (int i = 0; i < 10; ++i) {
    lost.see(there);
    EXPECT_TRUE(lost.is_lost() || lost.error_m() < 0.05) << i << ", off by " << lost.error_m() << " m";
  }
}

void remove(Feature& feature) {
  feature.described.clear();
  feature.view.texture.pixels =
      Image(feature.view.texture.pixels.width(), feature.view.texture.pixels.height());
}

/// Its patch no longer matches, its descriptors do.
void invert(Feature& feature) {
  Image& pixels = feature.view.texture.pixels;
  for (int v = 0; v < pixels.height(); ++v)
    for (int u = 0; u < pixels.width(); ++u) pixels(u, v) = static_cast<std::uint8_t>(255 - pixels(u, v));
}

/// A building that repeats: the upper part of the image is seen at two places. The map has the upper part of one and the lower
/// part of the other, so that everything in view matches at the wrong place. At the right one more landmarks are recognized,
/// but every second patch no longer matches. Is the camera back at the wrong place?
bool is_back_at_the_wrong_place(bool is_right_mapped, bool was_there) {
  CameraSlamSettings settings = defaults();
  settings.search.max_measurements = settings.map.wanted_visible = 50;
  settings.initialization.max_new_per_frame = 5;
  settings.initialization.selection = InitializationSettings::Selection::grid;
  Lost lost(wall_with_sheet(), 3.2, settings, was_there ? 0.5 : 0);
  const CameraState right = camera_at({0.02, 0.6, 0}), wrong = camera_at({0.02, 2.6, 0});
  constexpr int upper_rows = 110;
  bool is_second = false;
  auto features = lost.estimator.cameras()[0].camera().features;
  for (auto& [id, feature] : features) {
    const auto at = position_of(lost.estimate.landmarks.at(id), lost.estimate);
    if (!at) continue;
    const Eigen::Vector3d point = at->position;
    const bool is_upper = pixel_of(wrong, {point.x(), wrong.y(), point.z()}).y() < upper_rows;
    const bool is_near_wrong = point.y() > 1.6;
    if (is_upper != is_near_wrong || (!is_near_wrong && !is_right_mapped))
      remove(feature);
    else if (!is_near_wrong && (is_second = !is_second))
      invert(feature);
    lost.estimator.camera(0).adopt(id, feature);
  }
  Image seen = lost.wall.seen_from(right);
  const Image above = lost.wall.seen_from(wrong);
  for (int v = 0; v < upper_rows; ++v) std::copy(above.row(v), above.row(v) + above.width(), seen.row(v));
  const auto shared = std::make_shared<const Image>(seen);
  for (int i = 0; i < 12 && lost.is_lost(); ++i)
    lost.estimator.update(lost.estimate, {}, seeing(shared), tick(lost.k++));
  if (!lost.is_lost()) {
    EXPECT_LT((lost.estimate.camera_state() - wrong).head<3>().norm(), 0.1);
  }
  return !lost.is_lost();
}

TEST(Relocalization, NotWhereLessOfTheImageIsRecognized) {
  for (const bool was_there : {false, true}) {
    EXPECT_FALSE(is_back_at_the_wrong_place(true, was_there)) << was_there;
    EXPECT_TRUE(is_back_at_the_wrong_place(false, was_there))
        << was_there << ": nothing distinguishes the places";
  }
}

}  // namespace
}  // namespace incognita
