// What the estimator does when a camera moves by more than its motion model expects: it searches the image again.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/mapper/prediction.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita::synthetic {
namespace {

CameraSlamSettings settings_with(double min_matched_share) {
  CameraSlamSettings settings = few_features();
  settings.filter.sigma_pixel_px = 0.5;
  settings.health.min_matched_share = min_matched_share;
  settings.search.levels = 4;
  return settings;
}

/// Cameras side by side, each on a body of its own, that slide to the left by 2 cm a frame and then stand still.
class Sliding {
 public:
  explicit Sliding(const CameraSlamSettings& settings, std::size_t cameras = 1)
      : estimator_(estimator_of(settings, cameras)), truth_(cameras) {
    for (int i = 0; i < 12; ++i) {
      for (std::size_t k = 0; k < cameras; ++k)
        truth_[k] = camera_at({0, 0.02 * std::min(i, 8) - 0.1 * static_cast<double>(k), 0});
      see();
    }
    for (std::size_t k = 0; k < cameras; ++k) {
      EXPECT_GE(matched(k), 8);
      EXPECT_LT(error(k).norm(), 0.03);
    }
  }

  /// Displaces a camera in its own axes: m to the right, rad about the axis down.
  void displace(std::size_t k, double right_m, double turn_rad) {
    CameraState& x = truth_[k];
    x.head<3>() += rotation_matrix<double>(free_camera::orientation(x)) * Eigen::Vector3d(right_m, 0, 0);
    x.segment<4>(3) = quaternion_product<double>(x.segment<4>(3), quaternion_exp<double>({0, turn_rad, 0}));
  }
  void see() {
    std::vector<std::shared_ptr<const Image>> images;
    for (const CameraState& x : truth_) images.push_back(wall_with_sheet().shared_view(x));
    see(images);
  }
  void see(const std::vector<std::shared_ptr<const Image>>& images) {
    Observation observation;
    for (const auto& image : images) observation.bodies.emplace_back().images = {image};
    estimator_.update(estimate_, {}, observation, tick(frame_++));
  }

  int matched(std::size_t k = 0) const { return estimator_.cameras()[k].matched(); }
  int predicted(std::size_t k = 0) const { return estimator_.cameras()[k].camera().predicted; }
  /// Of the pose, m and rad.
  Eigen::Matrix<double, 6, 1> error(std::size_t k = 0) const {
    return camera_error(truth_[k], estimate_.belief.mean(estimate_.bodies[k].block)).head<6>();
  }
  const Estimate& estimate() const { return estimate_; }

 private:
  static SlamEstimator estimator_of(const CameraSlamSettings& s, std::size_t cameras) {
    EstimatorSettings settings;
    settings.bodies.assign(cameras, free_camera_body(s.filter));
    settings.health = s.health;
    std::vector<FeatureTracker> trackers;
    for (std::size_t k = 0; k < cameras; ++k)
      trackers.emplace_back(camera, s, CameraPlacement{.body = k, .target = sheet_target()}, k + 1);
    return SlamEstimator(std::move(settings), std::move(trackers));
  }

  SlamEstimator estimator_;
  std::vector<CameraState> truth_;
  Estimate estimate_;
  int frame_ = 0;
};

constexpr double jolt_m = 0.06;  // of 1.4 m: 8 px, beyond the search ellipses

TEST(Jolt, IsFollowed) {
  Sliding without(settings_with(0));  // never searches again
  without.displace(0, jolt_m, 0);
  without.see();
  EXPECT_LT(without.matched(), 0.5 * without.predicted());
  Sliding t(settings_with(0.25));
  t.displace(0, jolt_m, 0);
  t.see();
  EXPECT_GE(t.matched(), 0.8 * t.predicted());
  EXPECT_EQ(t.estimate().status.state, TrackingState::tracking);
  EXPECT_LT(t.error().head<3>().norm(), 0.02);
  EXPECT_LT(t.error().tail<3>().norm(), 0.01);
}

TEST(Jolt, OfOneCameraIsLeftToIt) {
  Sliding t(settings_with(0.25), 2);
  t.displace(1, -jolt_m, 0);
  t.see();
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_GE(t.matched(k), 0.8 * t.predicted(k)) << k;
    EXPECT_LT(t.error(k).head<3>().norm(), 0.03) << k;
  }
}

/// An image of another place is no jolt, whatever matches by chance: the belief is the one of a frame without any match.
TEST(Jolt, IsNotSeenInAnImageOfAnotherPlace) {
  for (const std::uint64_t seed : {21, 22, 23, 24, 25}) {
    Sliding t(settings_with(0.25)), blind(settings_with(0.25));
    t.see({Wall(1.4, seed).shared_view(camera_at({0, 0.3, 0.1}))});
    blind.see({seeing_gray(8).bodies[0].images.at(0)});
    EXPECT_EQ(t.matched(), 0) << seed;
    EXPECT_EQ(t.estimate().status.state, TrackingState::degraded) << seed;
    EXPECT_EQ(t.estimate().belief.dense_covariance(), blind.estimate().belief.dense_covariance()) << seed;
    EXPECT_EQ(t.estimate().camera_state(), blind.estimate().camera_state()) << seed;
  }
}

/// A camera that was carried away is not taken for one that jolted: no landmark is where a jolt could have moved it.
TEST(Jolt, IsNotACameraThatWasCarriedAway) {
  for (const double right_m : {-0.5, -0.3, 0.3, 0.5}) {
    Sliding t(settings_with(0.25));
    const CameraState before = t.estimate().camera_state();
    t.displace(0, right_m, 0);
    t.see();
    EXPECT_EQ(t.matched(), 0) << right_m;
    EXPECT_LT(camera_error(before, t.estimate().camera_state()).head<3>().norm(), 0.02) << right_m;
  }
}

CameraSlamSettings settings_with_alignment() {
  CameraSlamSettings settings = settings_with(0.25);
  settings.search.align_images = true;
  return settings;
}

/// By 0.12 rad in a frame, 23 px, where one of 0.03 rad is expected at most.
TEST(Turn, BeyondTheMotionModelIsFollowed) {
  Sliding without(settings_with(0.25));
  without.displace(0, 0, 0.12);
  without.see();
  EXPECT_EQ(without.matched(), 0);
  Sliding t(settings_with_alignment());
  t.displace(0, 0, 0.12);
  t.see();
  EXPECT_GE(t.matched(), 0.8 * t.predicted());
  EXPECT_LT(t.error().head<3>().norm(), 0.03);
  EXPECT_LT(t.error().tail<3>().norm(), 0.01);
}

/// Cut-outs around the landmarks, as large as their patches need at half the resolution, in front of another wall that the camera
/// sees turned.
std::shared_ptr<const Image> before_turned_wall(const Estimate& estimate, double turn_rad) {
  static const Wall behind(1.4, 50);
  CameraState turned = estimate.camera_state();
  turned.segment<4>(3) =
      quaternion_product<double>(turned.segment<4>(3), quaternion_exp<double>({0, turn_rad, 0}));
  const Image landmarks = wall_with_sheet().seen_from(estimate.camera_state());
  Image image = behind.seen_from(turned);
  for (const Match& match : estimate.last.matches) {
    if (match.predicted.size() == 0) continue;
    const Eigen::Vector2i at = match.predicted.array().round().cast<int>();
    constexpr int half_px = 14;
    for (int y = std::max(at.y() - half_px, 0); y <= std::min(at.y() + half_px, image.height() - 1); ++y)
      for (int x = std::max(at.x() - half_px, 0); x <= std::min(at.x() + half_px, image.width() - 1); ++x)
        image(x, y) = landmarks(x, y);
  }
  return std::make_shared<const Image>(std::move(image));
}

/// What moves behind the landmarks turns the whole image, but not them.
TEST(Turn, OfTheBackgroundIsNotFollowed) {
  Sliding t(settings_with_alignment());
  t.see({before_turned_wall(t.estimate(), 0)});
  ASSERT_GE(t.matched(), 0.8 * t.predicted());
  t.see({before_turned_wall(t.estimate(), 0.12)});
  EXPECT_GE(t.matched(), 0.8 * t.predicted());
  EXPECT_LT(t.error().norm(), 0.03);
}

TEST(AddJump, TurnsTheCameraAndNotItsRate) {
  CameraState x = camera_at({0, 0, 1});
  x.tail<3>() << 0.1, 0.2, 0.3;
  Estimate e = estimate_at(x, 1e-6 * CameraCov::Identity());
  const Eigen::Vector3d turn(0.01, -0.02, 0.03);
  add_jump(e, 0, {turn, 0.05, 0.04}, 0.1);
  const CameraState after = e.belief.mean(e.body().block);
  Eigen::Matrix<double, 12, 1> moved;
  FreeCameraMotion::chart.minus({after.data(), 13}, {x.data(), 13}, {moved.data(), 12});
  EXPECT_LT((moved.segment<3>(3) - turn).norm(), 1e-9);
  EXPECT_LT(moved.head<3>().norm() + moved.tail<6>().norm(), 1e-12);
  const Eigen::MatrixXd P = e.belief.covariance(e.body().block);
  EXPECT_NEAR(P(0, 0), 1e-6 + 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(P(4, 4), 1e-6 + 0.04 * 0.04, 1e-12);
  EXPECT_NEAR(P(7, 7), 1e-6 + 0.5 * 0.5, 1e-12);
  EXPECT_NEAR(P(10, 10), 1e-6 + 0.4 * 0.4, 1e-12);
  EXPECT_EQ(P(0, 6), 0);
}

}  // namespace
}  // namespace incognita::synthetic
