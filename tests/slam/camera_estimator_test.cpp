// The camera estimator's state: when it began, what it does without images, and what it refuses.
#include "incognita/slam/estimator/single_camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita {
namespace {

const Camera camera(WideAngleCamera{.kd1 = 9e-6});

/// Blocks of random greys, so that corners are everywhere.
std::shared_ptr<const Image> blocks(std::uint64_t seed) {
  RandomStream random(seed, "blocks");
  constexpr int side = 16;
  auto image = std::make_shared<Image>(camera.width(), camera.height());
  for (int v = 0; v < image->height(); v += side)
    for (int u = 0; u < image->width(); u += side) {
      const auto gray = static_cast<std::uint8_t>(20 + random.below(215));
      for (int y = v; y < std::min(v + side, image->height()); ++y)
        for (int x = u; x < std::min(u + side, image->width()); ++x) (*image)(x, y) = gray;
    }
  return image;
}

Observation seeing(std::shared_ptr<const Image> image) {
  Observation observation;
  observation.bodies.emplace_back().images = {std::move(image)};
  return observation;
}

/// Four patches that are in no image of blocks.
Target target() {
  Target target;
  target.name = "rings";
  target.normal = {-1, 0, 0};
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(0, 0.1, 0.1), {0, -0.1, 0.1}, {0, -0.1, -0.1}, {0, 0.1, -0.1}}) {
    Image patch(11, 11);
    for (int v = 0; v < 11; ++v)
      for (int u = 0; u < 11; ++u)
        patch(u, v) = static_cast<std::uint8_t>(((u - 5) * (u - 5) + (v - 5) * (v - 5)) * 5 % 250);
    target.corners.push_back({at, patch});
  }
  return target;
}

bool searches_rays(const Estimate& estimate) {
  return std::any_of(estimate.last.matches.begin(), estimate.last.matches.end(),
                     [](const Match& match) { return match.ray; });
}

SlamEstimator estimator(const CameraSlamSettings& settings = synthetic::few_features()) {
  return single_camera(camera, std::nullopt, settings, 10, 1);
}

/// `k` ticks after a first one of any number and time.
Tick tick(std::int64_t first_frame, double first_t, int k) {
  return {first_frame + k, first_t + k / 30.0, k == 0 ? 0 : 1 / 30.0};
}

struct Begins {
  std::int64_t frame;
  double t;
};
const Begins begins[] = {{0, 0}, {17, 1.3e9}, {3, -5}};

TEST(SingleCamera, SearchesForItsTargetAsLongWhateverItsFirstTick) {
  const auto image = blocks(1);
  for (const auto& [frame, t] : begins) {
    SlamEstimator searching = single_camera(camera, target(), {}, 2, 1);
    Estimate estimate;
    for (const int k : {0, 1, 30, 59}) {
      searching.update(estimate, {}, seeing(image), tick(frame, t, k));
      EXPECT_EQ(estimate.status.state, TrackingState::starting) << "frame " << frame << " + " << k;
    }
    searching.update(estimate, {}, seeing(image), tick(frame, t, 62));
    EXPECT_EQ(estimate.status.state, TrackingState::lost) << "after 2 s without its target";
    // The same estimator, another estimate: another beginning
    Estimate anew;
    searching.update(anew, {}, seeing(image), tick(frame, t + 100, 0));
    EXPECT_EQ(anew.status.state, TrackingState::starting);
  }
}

TEST(SingleCamera, TracksAlikeWhateverItsFirstTick) {
  std::vector<Eigen::VectorXd> means;
  std::vector<Eigen::MatrixXd> covariances;
  for (const auto& [frame, t] : begins) {
    SlamEstimator tracking = estimator();
    Estimate estimate;
    for (int k = 0; k < 20; ++k) tracking.update(estimate, {}, seeing(blocks(1)), tick(frame, t, k));
    EXPECT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
    EXPECT_GE(estimate.mapped_count(), 8);
    means.emplace_back(estimate.camera_state());
    covariances.emplace_back(estimate.belief.covariance(estimate.body().block));
    EXPECT_GT(estimate.entropy.map, -1e9);
  }
  EXPECT_EQ(means[0], means[1]);
  EXPECT_EQ(means[0], means[2]);
  EXPECT_EQ(covariances[0], covariances[1]);
}

/// A fixed number of states is reserved for errors that last: two for each match, as if all landmarks of the map could match.
TEST(SingleCamera, ReservesLastingErrorsForNoMoreMatchesThanTheMapHasLandmarks) {
  const auto reserved = [](int most_measurements) {
    CameraSlamSettings settings;
    settings.filter.sigma_lasting_px = 0.1;
    settings.filter.adapt_sigma_pixel = false;
    settings.map.max_landmarks = 30;
    settings.search.max_measurements = most_measurements;
    SlamEstimator tracking = estimator(settings);
    Estimate estimate;
    tracking.update(estimate, {}, seeing(blocks(1)), tick(0, 0, 0));
    return estimate.lasting_errors.size();
  };
  EXPECT_EQ(reserved(20), 40u) << "two for each match";
  EXPECT_EQ(reserved(10000), 60u) << "of 30 landmarks";
}

TEST(SingleCamera, ClosesLoopsOnlyWithAllCorrelations) {
  const auto closes = [](Decorrelation decorrelate) {
    EstimatorSettings settings;
    settings.bodies = {free_camera_body({})};
    settings.filter.decorrelate = decorrelate;
    std::vector<FeatureTracker> cameras;
    cameras.emplace_back(camera, CameraSlamSettings{}, CameraPlacement{}, 1);
    const SlamEstimator tracking(std::move(settings), std::move(cameras));
    return tracking.cameras()[0].camera().settings.relocalization.close_loops;
  };
  EXPECT_TRUE(closes(Decorrelation::nothing));
  EXPECT_FALSE(closes(Decorrelation::map));
}

/// The alignment of whole images takes a shadow that sweeps over the scene for a turn of the camera. The search without it finds
/// more features.
TEST(SingleCamera, AMovingShadowIsNoTurn) {
  const auto scene = blocks(1);
  SlamEstimator tracking = estimator(CameraSlamSettings{});
  Estimate estimate;
  for (int k = 0; k < 30; ++k) {
    auto image = std::make_shared<Image>(scene->width(), scene->height());
    const double moved_px = 40.0 * std::max(0, k - 20);
    for (int v = 0; v < image->height(); ++v)
      for (int u = 0; u < image->width(); ++u)
        (*image)(u, v) = static_cast<std::uint8_t>(
            0.3 * (*scene)(u, v) + 85 + 80 * std::sin(2 * std::numbers::pi * (u - moved_px) / 200));
    tracking.update(estimate, {}, seeing(image), tick(0, 0, k));
    EXPECT_EQ(estimate.status.state, TrackingState::tracking)
        << "frame " << k << ": " << estimate.status.reason;
    if (k > 0) {
      EXPECT_GT(estimate.last.matched, 10) << "frame " << k;
    }
  }
  EXPECT_LT(estimate.camera_state().head<3>().norm(), 0.05);
}

/// A fifth of the view stays what it was, as after a displacement to a place that looks alike by chance.
TEST(SingleCamera, FewFeaturesCorrectOneFrameAndNotTheNext) {
  const auto scene = blocks(1), elsewhere = blocks(2);
  auto mixed = std::make_shared<Image>(*elsewhere);
  for (int v = 0; v < mixed->height(); ++v) std::copy_n(scene->row(v), mixed->width() / 5, mixed->row(v));
  SlamEstimator tracking = estimator(CameraSlamSettings{});
  Estimate estimate;
  for (int k = 0; k < 20; ++k) tracking.update(estimate, {}, seeing(scene), tick(0, 0, k));
  tracking.update(estimate, {}, seeing(mixed), tick(0, 0, 20));
  const double share = estimate.last.matched / static_cast<double>(estimate.last.predicted);
  EXPECT_GT(share, HealthSettings{}.min_matched_share);
  EXPECT_LT(share, 1.6 * HealthSettings{}.min_matched_share);
  tracking.update(estimate, {}, seeing(mixed), tick(0, 0, 21));
  EXPECT_EQ(estimate.last.matched, 0);
  tracking.update(estimate, {}, seeing(scene), tick(0, 0, 22));
  EXPECT_GT(estimate.last.matched, 10) << "the features are still known";
}

TEST(SingleCamera, TracksEvenIfMostFeaturesMustMatch) {
  CameraSlamSettings settings;
  settings.health.min_matched_share = 0.8;
  SlamEstimator tracking = estimator(settings);
  Estimate estimate;
  for (int k = 0; k < 20; ++k) tracking.update(estimate, {}, seeing(blocks(1)), tick(0, 0, k));
  EXPECT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
}

/// An image may go when the tick is over: nothing of it is looked at in the next.
TEST(SingleCamera, KeepsNoImageAndSearchesNothingWithoutOne) {
  CameraSlamSettings settings = synthetic::few_features();
  settings.initialization.method = InitializationSettings::Method::depth_line;
  settings.map.wanted_visible = 20;
  settings.health.min_matches = 1;
  SlamEstimator tracking = single_camera(synthetic::camera, synthetic::sheet_target(), settings, 10, 1);
  Estimate estimate;
  auto image = synthetic::wall_with_sheet().shared_view(synthetic::camera_at({0, 0, 0}));
  // Rays are followed while the anchors hold the camera
  for (int k = 0; k < 6; ++k) tracking.update(estimate, {}, seeing(image), tick(0, 0, k));
  ASSERT_TRUE(searches_rays(estimate)) << estimate.status.reason;
  const std::size_t landmarks = estimate.landmarks.size();
  const std::weak_ptr<const Image> gone = image;
  image.reset();
  ASSERT_TRUE(gone.expired());
  for (int k = 6; k < 9; ++k) {
    tracking.update(estimate, {}, {}, tick(0, 0, k));
    EXPECT_FALSE(searches_rays(estimate));
    EXPECT_EQ(estimate.last.matched, 0);
    EXPECT_EQ(estimate.landmarks.size(), landmarks) << "no line failed by it";
    const bool overdue = k > 6;  // by a quarter of a period
    EXPECT_EQ(estimate.status.state, overdue ? TrackingState::degraded : TrackingState::tracking)
        << estimate.status.reason;
  }
}

std::string refusal(const std::function<void(CameraSlamSettings&)>& change) {
  CameraSlamSettings settings = synthetic::few_features();
  change(settings);
  try {
    estimator(settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SingleCamera, RefusesSettingsThatCannotBe) {
  EXPECT_EQ(refusal([](auto&) {}), "accepted");
  EXPECT_NE(refusal([](auto& s) {
              s.filter.sigma_lasting_px = 0.1;
              s.filter.adapt_sigma_pixel = true;
            }).find("sensor.adapt_sigma_pixel follows all of the error"),
            std::string::npos);
  EXPECT_EQ(refusal([](auto& s) {
              s.filter.sigma_lasting_px = 0.1;
              s.filter.adapt_sigma_pixel = false;
            }),
            "accepted");
  EXPECT_NE(refusal([](auto& s) {
              s.filter.sigma_lasting_px = 0.1;
              s.filter.adapt_sigma_pixel = false;
              s.initialization.method = InitializationSettings::Method::depth_line;
            }).find("take sensor.sigma_lasting_px = 0"),
            std::string::npos);
  EXPECT_EQ(refusal([](auto& s) { s.filter.sigma_pixel_px = 0; }),
            "sensor.sigma_pixel_px = 0: must be more than 0, and finite");
  EXPECT_EQ(refusal([](auto& s) { s.filter.sigma_acceleration_m_s2 = -1; }),
            "vehicle.sigma_acceleration_m_s2 = -1: must be 0 or more, and finite");
  EXPECT_EQ(refusal([](auto& s) { s.filter.sigma_start_velocity_m_s = std::nan(""); }),
            "start.sigma_velocity_m_s = nan: must be 0 or more, and finite");
  EXPECT_EQ(refusal([](auto& s) { s.search.patch_size_px = 10; }),
            "search.patch_size_px = 10: must be odd, 9 to 15");
  EXPECT_EQ(refusal([](auto& s) { s.search.gate_probability = 1; }),
            "search.gate_probability = 1: must be more than 0 and less than 1");
  EXPECT_EQ(
      refusal([](auto& s) { s.initialization.max_depth_m = 0.1; }),
      "landmark_initialization.max_depth_m = 0.1: must be more than landmark_initialization.min_depth_m, and finite");
  EXPECT_EQ(refusal([](auto& s) { s.initialization.particles = 1; }),
            "landmark_initialization.particles = 1: must be 2 or more");
  EXPECT_EQ(refusal([](auto& s) { s.map.max_scale = 1; }),
            "map.max_scale = 1: must be more than 1, and finite");
  EXPECT_EQ(refusal([](auto& s) { s.health.min_matches = 0; }), "health.min_matches = 0: must be 1 or more");
}

TEST(SingleCamera, RefusesATargetOrWheelsThatCannotBe) {
  Target three = target();
  three.corners.pop_back();
  EXPECT_THROW(single_camera(camera, three, {}, 10, 1), std::invalid_argument);
  EXPECT_THROW(single_camera(camera, target(), {}, 0, 1), std::invalid_argument);
  WheelOdometry odometry;
  odometry.sigma_turn_rate_rad_s = 0;
  EXPECT_THROW(single_camera(camera, target(), {}, 10, 1, odometry), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
