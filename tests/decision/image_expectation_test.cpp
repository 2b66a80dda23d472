// Predicted measurements of a camera: limited to what it would search for and initialize.
#include "incognita/decision/image_expectation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/motion/mount.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {
namespace {

/// A camera at the origin, facing +x, and points ahead with random uncertainties.
Estimate before(int landmarks) {
  Estimate e;
  CameraState x = CameraState::Zero();
  x.segment<4>(3) = level_gaze(0);
  e.bodies.emplace_back().block =
      e.belief.add_vehicle(FreeCameraMotion::chart, x, 1e-4 * FreeCameraMotion::Jacobian::Identity());
  e.started = true;
  RandomStream random(4, "test");
  for (int i = 0; i < landmarks; ++i) {
    Landmark landmark{};
    landmark.camera = 0;
    landmark.id = new_id(e);
    const Eigen::Vector3d at(2 + random.uniform(), random.uniform() - 0.5, random.uniform() - 0.5);
    const double sigma = 0.01 + 0.2 * random.uniform();
    landmark.block =
        e.belief.augment(PointLandmark::chart, at, {}, sigma * sigma * Eigen::Matrix3d::Identity());
    e.landmarks.emplace(landmark.id, landmark);
  }
  return e;
}

std::vector<ExpectedLandmark> predicted_before(int count) {
  std::vector<ExpectedLandmark> all;
  for (int i = 0; i < count; ++i) all.push_back({i, {3, 0.02 * i, 0.1}});
  return all;
}

std::vector<PredictedMeasurement> expect(const Estimate& e, const std::vector<ExpectedLandmark>& unseen,
                                         const CameraSlamSettings& slam, bool as_mapped) {
  ImageExpectation expectation(WideAngleCamera{}, slam, as_mapped);
  expectation.prepare(e, unseen, 1.5);
  std::vector<PredictedMeasurement> measurements;
  expectation.add(e.camera_state(), measurements);
  return measurements;
}

std::ptrdiff_t count(const std::vector<PredictedMeasurement>& measurements, PredictedMeasurement::Of of) {
  return std::count_if(measurements.begin(), measurements.end(),
                       [&](const PredictedMeasurement& l) { return l.of == of; });
}

TEST(ImageExpectation, PredictsTheMostUncertainLandmarks) {
  const Estimate e = before(20);
  CameraSlamSettings slam;
  slam.search.max_measurements = 20;
  auto trace = [&](const PredictedMeasurement& l) {
    return (l.Hv * e.belief.covariance(e.body().block) * l.Hv.transpose() +
            l.Hl * e.belief.covariance(l.block) * l.Hl.transpose())
        .trace();
  };
  std::vector<PredictedMeasurement> all = expect(e, {}, slam, false);
  ASSERT_EQ(all.size(), 20u);
  slam.search.max_measurements = 7;
  const std::vector<PredictedMeasurement> some = expect(e, {}, slam, false);
  ASSERT_EQ(some.size(), 7u);
  std::sort(all.begin(), all.end(), [&](const PredictedMeasurement& a, const PredictedMeasurement& b) {
    return trace(a) > trace(b);
  });
  for (int i = 0; i < 7; ++i) {
    const BlockId block = all[static_cast<std::size_t>(i)].block;
    EXPECT_TRUE(std::any_of(some.begin(), some.end(),
                            [&](const PredictedMeasurement& l) { return l.block == block; }))
        << i << " of the most uncertain is not searched for";
  }
}

TEST(ImageExpectation, PredictsNoMoreNewLandmarksThanWouldBeInitialized) {
  CameraSlamSettings slam;
  slam.map.wanted_visible = 12;
  for (const int mapped : {0, 5, 11, 12, 20}) {
    const auto measurements = expect(before(mapped), predicted_before(30), slam, true);
    EXPECT_EQ(count(measurements, PredictedMeasurement::Of::unseen), std::max(0, 12 - mapped))
        << mapped << " mapped";
    EXPECT_EQ(count(measurements, PredictedMeasurement::Of::mapped), std::min(12, mapped));
  }
  EXPECT_EQ(count(expect(before(2), predicted_before(3), slam, true), PredictedMeasurement::Of::unseen), 3);
  EXPECT_EQ(count(expect(before(20), predicted_before(30), slam, false), PredictedMeasurement::Of::unseen),
            30)
      << "all of them by default";
}

/// On a vehicle the measurement depends on the error of its pose, by way of the mount.
TEST(ImageExpectation, OfAMountedCameraIsLinearizedInTheErrorOfItsVehicle) {
  const Eigen::Vector3d at(0.1, -0.2, 0.3);
  Estimate e;
  Body& body = e.bodies.emplace_back();
  body.block = e.belief.add_vehicle(planar::pose_chart, SmallVector(at), 1e-4 * Eigen::Matrix3d::Identity());
  Landmark landmark;
  landmark.id = new_id(e);
  landmark.camera = 0;
  const Eigen::Vector3d point(3, 0.6, 0.8);
  landmark.block = e.belief.augment(PointLandmark::chart, point, {}, 1e-4 * Eigen::Matrix3d::Identity());
  e.landmarks.emplace(landmark.id, landmark);
  const Mount mount{.forward_m = 0.2, .left_m = -0.1, .up_m = 0.5, .pitch_rad = 0.05, .yaw_rad = 0.1};
  ImageExpectation expectation(WideAngleCamera{}, {}, false, {0, 0, DifferentialDrive{}, mount});
  expectation.prepare(e, {}, 1);
  std::vector<PredictedMeasurement> measurements;
  expectation.add(SmallVector(at), measurements);
  ASSERT_EQ(measurements.size(), 1u);
  ASSERT_EQ(measurements[0].Hv.cols(), 3);
  const auto pixel = [&](const Eigen::Vector3d& pose) {
    return PointLandmark::predict_measurement(Camera(WideAngleCamera{}), mount.on(on_floor(pose)).camera,
                                              point)
        ->pixel;
  };
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(k);
    EXPECT_NEAR(((pixel(at + step) - pixel(at - step)) / 2e-6 - measurements[0].Hv.col(k)).norm(), 0, 1e-4)
        << k;
  }
  EXPECT_TRUE(expectation.in_view(SmallVector(at), point));
  EXPECT_FALSE(expectation.in_view(SmallVector(at + Eigen::Vector3d(0, 0, 3)), point)) << "turned away";
}

}  // namespace
}  // namespace incognita
