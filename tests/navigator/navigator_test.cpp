// The push interface gives the same estimates as the loop, and refuses invalid calls.
#include "incognita/navigator/navigator.hpp"

#include <gtest/gtest.h>

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

TEST(Navigator, ReadsImagesWithAStride) {
  constexpr int width = 320, height = 240, stride = 352;
  std::vector<std::uint8_t> buffer(static_cast<std::size_t>(stride) * height, 0);
  Image image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image(u, v) = buffer[static_cast<std::size_t>(v) * stride + static_cast<std::size_t>(u)] =
          static_cast<std::uint8_t>(((u / 16) * 7919 + (v / 16) * 104729) % 211 + 20);
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

}  // namespace
}  // namespace incognita
