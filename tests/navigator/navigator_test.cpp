// The push interface gives the same estimates as the loop, and refuses invalid calls.
#include "incognita/navigator/navigator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "incognita/slam/estimator/single_camera.hpp"

namespace incognita {
namespace {

const Eigen::Vector3d start(0, 0, 0);

EstimatorSettings one_vehicle() {
  EstimatorSettings settings;
  settings.bodies.push_back(body_with_sensor(DifferentialDrive{}, RangeBearingSensor{}, start,
                                             Eigen::Vector3d(0.1, 0.1, 0.02), Eigen::Vector2d(0.1, 0.05),
                                             Eigen::Vector2d(0.1, 0.02)));
  settings.bodies[0].sigma_fix_m = 0.5;
  return settings;
}

std::vector<PointDetection> two_posts() {
  return {{4, Eigen::Vector2d(3, 0.5)}, {9, Eigen::Vector2d(5, -1)}};
}

TEST(Navigator, GivesTheEstimateOfTheLoop) {
  SlamEstimator estimator(one_vehicle());
  Navigator navigator{SlamEstimator(one_vehicle())};
  Estimate estimate;
  for (int k = 0; k < 20; ++k) {
    const double t = 5 + 0.1 * k;
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    body.odometry = {{t - 0.05, {0.5, 0.1}}};
    if (k == 10) body.fixes = {{t - 0.02, {0.4, 0.1}}};
    body.landmarks = two_posts();
    estimator.update(estimate, {}, observation, {k, t, k > 0 ? 0.1 : 0});
    navigator.add_odometry({0.5, 0.1}, t - 0.05);
    if (k == 10) navigator.add_fix({0.4, 0.1}, t - 0.02);
    EXPECT_EQ(navigator.add_detections(two_posts(), t).state, estimate.status.state);
  }
  EXPECT_EQ(navigator.estimate().belief.dense_covariance(), estimate.belief.dense_covariance());
  EXPECT_EQ(navigator.pose().pose.position, estimate.body().pose.position);
  EXPECT_EQ(navigator.pose().covariance, estimate.body().pose_covariance);
  const auto landmarks = navigator.landmarks();
  ASSERT_EQ(landmarks.size(), 2u);
  EXPECT_EQ(landmarks[0].id, 4);
  EXPECT_EQ(landmarks[1].id, 9);
  EXPECT_EQ(landmarks[0].position.head<2>(),
            Eigen::Vector2d(estimate.belief.mean(estimate.landmarks.at(4).block)));
  EXPECT_EQ(landmarks[0].covariance(2, 2), 0) << "on the plane";
}

TEST(Navigator, AdvancesByOdometryAlone) {
  Navigator navigator{SlamEstimator(one_vehicle())};
  navigator.advance(0);
  navigator.add_odometry({1, 0}, 0);
  navigator.advance(2);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 2, 1e-12);
  EXPECT_GT(navigator.pose().covariance(0, 0), 0.01);
}

/// Tiles of different brightness, whose corners are features.
Image tiles() {
  Image image(320, 240);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      image(u, v) = static_cast<std::uint8_t>(((u / 16) * 7919 + (v / 16) * 104729) % 211 + 20);
  return image;
}

TEST(Navigator, ReadsImagesWithAStride) {
  constexpr int width = 320, height = 240, stride = 352;
  std::vector<std::uint8_t> buffer(static_cast<std::size_t>(stride) * height, 0);
  const Image image = tiles();
  for (int v = 0; v < height; ++v)
    std::copy_n(image.row(v), width, buffer.begin() + static_cast<std::ptrdiff_t>(v) * stride);
  const auto estimate_with = [](const ImageView& view) {
    Navigator navigator(single_camera(WideAngleCamera{}, std::nullopt, {}, 10, 1));
    for (int k = 0; k < 5; ++k) navigator.add_image(view, k / 30.0);
    return navigator.estimate();
  };
  const Estimate strided = estimate_with({buffer.data(), width, height, stride}),
                 whole = estimate_with({image.row(0), width, height, width});
  EXPECT_GT(strided.mapped_count(), 4);
  EXPECT_EQ(strided.belief.dense_covariance(), whole.belief.dense_covariance());
}

TEST(Navigator, UsesReadingsAtTheirOwnTimes) {
  Navigator navigator{SlamEstimator(one_vehicle())};
  navigator.advance(0);
  navigator.add_odometry({1, 0}, 0);
  navigator.add_odometry({0, 0}, 1);  // comes before detections that were made earlier
  navigator.add_fix({1, 0}, 1.5);
  navigator.advance(0.98);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 0.98, 1e-12);
  EXPECT_TRUE(navigator.estimate().last.fixes.empty());
  navigator.advance(2);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 1, 0.01);
  EXPECT_EQ(navigator.estimate().last.fixes.size(), 1u);
}

TEST(Navigator, KeepsReadingsWhenDetectionsAreRefused) {
  Navigator navigator{SlamEstimator(one_vehicle())};
  navigator.advance(0);
  navigator.add_odometry({1, 0}, 0);
  EXPECT_THROW(navigator.add_detections({{1, Eigen::Vector2d(3, 0), 1}}, 1), std::invalid_argument);
  navigator.advance(2);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 2, 1e-12);
}

TEST(Navigator, PredictsABodyInSpaceWithoutInput) {
  EstimatorSettings settings;
  SmallVector at = SmallVector::Zero(13);
  at[3] = 1, at[7] = 0.5;  // m/s along x
  settings.bodies.push_back(body_with_sensor(FreeCameraMotion{}, CameraSensor{}, at,
                                             SmallVector::Constant(12, 0.01), SmallVector::Constant(6, 0.1),
                                             SmallVector::Constant(2, 1)));
  Navigator navigator{SlamEstimator(settings)};
  navigator.advance(0);
  const double before = navigator.pose().covariance(0, 0);
  navigator.advance(1);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 0.5, 1e-12);
  EXPECT_GT(navigator.pose().covariance(0, 0), 2 * before);
}

TEST(Navigator, PredictsByTheCommandThatIsExecuted) {
  EstimatorSettings settings;
  SmallVector at = SmallVector::Zero(13);
  at[3] = 1;
  BodyModel body = body_with_sensor(FreeCameraMotion{}, CameraSensor{}, at, SmallVector::Constant(12, 0.01),
                                    SmallVector::Constant(6, 0.1), SmallVector::Constant(2, 1));
  body.input = BodyModel::Input::commanded;
  settings.bodies.push_back(body);
  Navigator navigator{SlamEstimator(settings)};
  EXPECT_THROW(navigator.status(0), std::logic_error);
  navigator.advance(0);
  Command accelerate;
  accelerate.bodies.push_back({.input = SmallVector::Unit(6, 0)});  // 1 m/s^2 along x
  navigator.set_command(accelerate);
  navigator.advance(1);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 0.5, 1e-12);
  EXPECT_EQ(navigator.status(0).state, TrackingState::tracking);
  EXPECT_THROW(navigator.status(1), std::out_of_range);
  navigator.set_command({});
  navigator.advance(2);
  EXPECT_NEAR(navigator.pose().pose.position.x(), 1.5, 1e-12) << "on at 1 m/s";
}

TEST(Navigator, StartsAtFixesOfDifferentTimes) {
  EstimatorSettings settings = one_vehicle();
  settings.bodies.push_back(settings.bodies[0]);
  for (BodyModel& body : settings.bodies) body.start_time = BodyModel::StartTime::first_fix;
  Navigator navigator{SlamEstimator(settings)};
  navigator.add_fix({1, 2}, 0, 0);
  EXPECT_EQ(navigator.advance(0).state, TrackingState::starting);
  navigator.add_fix({5, 6}, 0.5, 1);
  EXPECT_EQ(navigator.advance(0.5).state, TrackingState::tracking);
  EXPECT_EQ(navigator.pose(0).pose.position.head<2>(), Eigen::Vector2d(1, 2));
  EXPECT_NEAR((navigator.pose(1).pose.position.head<2>() - Eigen::Vector2d(5, 6)).norm(), 0, 1e-12);
}

SlamEstimator two_cameras_on_a_body() {
  const CameraSlamSettings s;
  EstimatorSettings settings;
  settings.bodies.push_back(free_camera_body(s.filter));
  std::vector<FeatureTracker> cameras;
  cameras.emplace_back(WideAngleCamera{}, s, CameraPlacement{}, 1);
  cameras.emplace_back(WideAngleCamera{}, s, CameraPlacement{.mount = Mount{.up_m = 0}}, 2);
  return SlamEstimator(std::move(settings), std::move(cameras));
}

/// The images of two cameras on one body come one after the other.
TEST(Navigator, StartsWithImagesOfDifferentTimes) {
  const Image image = tiles();
  Navigator navigator{two_cameras_on_a_body()};
  const ImageView view{image.row(0), 320, 240, 320};
  for (int k = 0; k < 6; ++k) navigator.add_image(view, k / 30.0, 0, static_cast<std::size_t>(k % 2));
  EXPECT_EQ(navigator.status().state, TrackingState::tracking) << navigator.status().reason;
  int of_camera[2] = {0, 0};
  for (const auto& [id, landmark] : navigator.estimate().landmarks)
    if (landmark.camera >= 0) ++of_camera[landmark.camera];
  EXPECT_GT(of_camera[0], 4);
  EXPECT_GT(of_camera[1], 4);
}

/// Ticks between images are no frames without matches.
TEST(Navigator, MayAdvanceMoreOftenThanImagesCome) {
  const Image image = tiles();
  Navigator navigator(single_camera(WideAngleCamera{}, std::nullopt, {}, 10, 1));
  for (int k = 0; k <= 100; ++k) {
    if (k % 20 == 0) navigator.add_image({image.row(0), 320, 240, 320}, 0.005 * k);
    navigator.advance(0.005 * k);
    EXPECT_NE(navigator.status().state, TrackingState::lost) << k;
  }
  for (int k = 101; k < 400; ++k) navigator.advance(0.005 * k);
  EXPECT_EQ(navigator.status().state, TrackingState::lost) << "the camera failed";
}

/// A body with two cameras whose images come 10 times a second, the second `offset_s` after the first, and ticks at
/// 200 Hz between them.
TrackingState after_images_in_turn(double offset_s, double until_s, double failed_from_s) {
  const Image image = tiles();
  Navigator navigator{two_cameras_on_a_body()};
  const ImageView view{image.row(0), 320, 240, 320};
  for (int k = 0; 0.005 * k < until_s; ++k) {
    const double t = 0.005 * k;
    navigator.advance(t);
    if (k % 20 != 0 || t >= failed_from_s) continue;
    navigator.add_image(view, t, 0, 0);
    navigator.add_image(view, t + offset_s, 0, 1);
    EXPECT_NE(navigator.status().state, TrackingState::lost) << t;
  }
  return navigator.status().state;
}

TEST(Navigator, CamerasMayTakeTheirImagesInTurn) {
  for (const double offset_s : {0.0, 0.002}) {
    EXPECT_EQ(after_images_in_turn(offset_s, 3, 9), TrackingState::tracking) << offset_s;
    EXPECT_EQ(after_images_in_turn(offset_s, 3.5, 2), TrackingState::lost) << "both failed";
  }
}

TEST(FrameCounter, JitterAndBurstsAreNoMissedFrames) {
  FrameCounter frames;
  frames.update(false, -1);
  EXPECT_FALSE(frames.missed());
  for (int k = 0; k < 300; ++k) {
    const double t = k / 30.0 + 0.002 * std::sin(7.1 * k);
    frames.update(false, t - 0.001);
    EXPECT_EQ(frames.missed().value_or(0), 0);
    frames.update(true, t);
    if (k == 100) frames.update(true, t + 0.005);
  }
  const double last = 299 / 30.0;
  frames.update(false, last + 1);
  EXPECT_NEAR(frames.missed().value(), 29.5, 1) << "one second without an image";
  frames.update(true, last + 1.01);
  frames.update(false, last + 1.04);
  EXPECT_EQ(frames.missed(), 0) << "the outage is no period";
  frames.update(false, last + 1.06);
  EXPECT_EQ(frames.missed(), 1);
}

std::string refusal(const std::function<void(Navigator&)>& act) {
  Navigator navigator{SlamEstimator(one_vehicle())};
  navigator.advance(3);
  try {
    act(navigator);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Navigator, RefusesInvalidCalls) {
  EXPECT_EQ(refusal([](Navigator& n) { n.add_odometry({0, 0}, 3); }), "accepted");
  EXPECT_NE(refusal([](Navigator& n) { n.add_odometry({0, 0}, 2.9); }).find("time order"), std::string::npos);
  EXPECT_NE(refusal([](Navigator& n) { n.advance(2); }).find("2.0"), std::string::npos);
  EXPECT_NE(refusal([](Navigator& n) { n.add_fix({0, 0}, 4, 1); }).find("body 1"), std::string::npos);
  EXPECT_NE(refusal([](Navigator& n) {
              n.add_image({nullptr, 4, 4, 4}, 4);
            }).find("image view"),
            std::string::npos);
  const std::uint8_t pixels[16] = {};
  EXPECT_NE(refusal([&](Navigator& n) {
              n.add_image({pixels, 4, 4, 3}, 4);
            }).find("stride of 3"),
            std::string::npos);
  EXPECT_THROW(Navigator{SlamEstimator(one_vehicle())}.pose(), std::logic_error) << "not started";
}

TEST(Navigator, RefusesMeasurementsThatNoModelUses) {
  const std::uint8_t pixels[16] = {};
  const auto expect_refused = [](const std::function<void(Navigator&)>& act, const char* because) {
    EXPECT_NE(refusal(act).find(because), std::string::npos) << refusal(act);
  };
  expect_refused([&](Navigator& n) { n.add_image({pixels, 4, 4, 4}, 4); }, "there are 0");
  expect_refused([](Navigator& n) { n.add_odometry({0, 0}, std::nan("")); }, "a time in s is needed");
  expect_refused(
      [](Navigator& n) {
        n.add_odometry({0, 0}, 5);
        n.add_odometry({0, 0}, 4);
      },
      "in time order");
  expect_refused(
      [](Navigator& n) {
        n.add_detections({{1, Eigen::Vector2d(3, 0), 1}}, 4);
      },
      "point sensor 2, but it has 1");
  expect_refused([](Navigator& n) { n.add_detections({}, 4, 0, {{-1, Eigen::Vector2d(3, 0)}}); }, "body 0");
  expect_refused(
      [](Navigator& n) {
        n.add_detections({{2'000'000'000, Eigen::Vector2d(3, 0)}}, 4);
      },
      "must be below");
  EstimatorSettings settings = one_vehicle();
  settings.bodies[0].sigma_fix_m = 0;
  Navigator without_fixes{SlamEstimator(settings)};
  EXPECT_THROW(without_fixes.add_fix({0, 0}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
