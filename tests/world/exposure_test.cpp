// Motion blur, rolling shutter and exposure steps of the simulated camera.
#include "incognita/world/rendered/exposure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/image_gain.hpp"
#include "incognita/world/motion_spline.hpp"
#include "incognita/world/rendered/render.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "incognita/world/rendered/room_ray.hpp"

namespace incognita {
namespace {

const WideAngleCamera lens{};

const std::shared_ptr<const Room>& room() {
  static const auto shared = std::make_shared<const Room>(RoomSettings{}, 1);
  return shared;
}

/// In front of the sheet on the wall at +x, facing it.
RigidPose start() { return {{1.6, 0, 1.3}, level_gaze(0)}; }

PoseInTime at_rest(const RigidPose& pose) {
  return [pose](double) { return pose; };
}
PoseInTime moving(const Eigen::Vector3d& velocity, const Eigen::Vector3d& rate = {0, 0, 0}) {
  return [=](double dt_s) { return extrapolated({start(), velocity, rate}, dt_s); };
}

Image exposed(const PoseInTime& pose, double duration_s, double readout_s) {
  Image out;
  ExposedCamera(*room(), lens, duration_s, readout_s).expose(pose, out);
  return out;
}

Image sharp(const RigidPose& pose) {
  Image out;
  render(*room(), RayTable(lens), pose.position, pose.world_from_body, out);
  return out;
}

/// Column of the left edge of the black rectangle in a row, from the integral of the profile across it.
double left_edge(const Image& image, int v) {
  constexpr int white_px = 118, black_px = 142;
  const double white = image(white_px, v), black = image(black_px, v);
  double bright = 0;
  for (int u = white_px; u < black_px; ++u) bright += (image(u, v) - black) / (white - black);
  return white_px - 0.5 + bright;
}

TEST(Exposure, OfAStillCameraIsTheSharpImage) {
  const Image expected = sharp(start());
  EXPECT_EQ(exposed(at_rest(start()), 0.02, 0), expected);
  EXPECT_EQ(exposed(at_rest(start()), 0, 0.03), expected);
  EXPECT_EQ(exposed(at_rest(start()), 0.02, 0.03), expected);
}

TEST(Exposure, HasAnImageForEachOneAndAHalfPixelsOfMotion) {
  const auto images = [](double rate, double duration_s) {
    return ExposedCamera(*room(), lens, duration_s, 0).images(moving({0, 0, 0}, {0, rate, 0}));
  };
  EXPECT_EQ(images(1, 0), 1);
  EXPECT_EQ(images(0.05, 0.005), 1);  // 0.05 px in the middle
  // 195 px/rad in the middle, and up to (1 + tan^2) times that at the edge
  EXPECT_GE(images(1, 0.02), 3);
  EXPECT_LE(images(1, 0.02), 6);
  EXPECT_EQ(images(50, 0.1), 32);
}

/// Blur is symmetric about the middle of the exposure: an edge stays in its place, and its slope falls.
TEST(Exposure, BlursAnEdgeAlongTheMotion) {
  const Image still = sharp(start()), blurred = exposed(moving({0, 0.7, 0}), 0.04, 0);  // 4 px at 1.4 m
  for (const int v : {110, 119, 128}) {
    EXPECT_NEAR(left_edge(blurred, v), left_edge(still, v), 0.1);
    int still_between = 0, blurred_between = 0;
    for (int u = 118; u < 142; ++u) {
      still_between += still(u, v) > 40 && still(u, v) < 200;
      blurred_between += blurred(u, v) > 40 && blurred(u, v) < 200;
    }
    EXPECT_LE(still_between, 2);
    EXPECT_GE(blurred_between, 3);
    EXPECT_LE(blurred_between, 6);
  }
}

/// A camera that moves to the left by v sees a vertical edge at distance d move to the right by f v / d per second, and
/// row after row later.
TEST(Exposure, ARollingShutterShearsAVerticalEdge) {
  constexpr double speed = 0.6, readout_s = 0.03, distance_m = 3 - 1.6;
  const Image still = sharp(start()), rolling = exposed(moving({0, speed, 0}), 0, readout_s);
  const double px_per_row = lens.fu * speed / distance_m * readout_s / lens.height;
  for (int v = 104; v <= 135; ++v)
    EXPECT_NEAR(left_edge(rolling, v) - left_edge(still, v), px_per_row * (v - 119.5), 0.06) << v;
}

TEST(Exposure, OfEachRowIsThatOfACameraAtRestThere) {
  const PoseInTime turning = moving({0.3, -0.2, 0.1}, {0.5, 1.5, -0.7});
  constexpr double readout_s = 0.03;
  const Image rolling = exposed(turning, 0, readout_s);
  for (const int v : {1, 7, 8, 60, 119, 200, 238}) {
    const Image row = sharp(turning(((v + 0.5) / lens.height - 0.5) * readout_s));
    int differ = 0;
    // the choice of smoothed pixels on edges depends on the rows beside
    for (int u = 0; u < lens.width; ++u) differ += std::abs(rolling(u, v) - row(u, v)) > 2;
    EXPECT_LE(differ, 6) << v;
  }
}

TEST(Exposure, IsBlackOutsideTheRoom) {
  EXPECT_EQ(exposed(moving({1000, 0, 0}), 0, 0.03), Image(320, 240, 0));
  EXPECT_EQ(exposed(at_rest({{30, 0, 0}, level_gaze(0)}), 0.02, 0.03), Image(320, 240, 0));
}

TEST(Exposure, RefusesNegativeDurations) {
  EXPECT_THROW(ExposedCamera(*room(), lens, -0.01, 0), std::invalid_argument);
  EXPECT_THROW(ExposedCamera(*room(), lens, 0, NAN), std::invalid_argument);
}

TEST(RayLength, IsTheDistanceToWallsAndBoxes) {
  RoomLayout layout;
  layout.inside = {{-3, -3, 0}, {3, 3, 2.5}};
  layout.boxes = {{{1, -0.5, 0}, {2, 0.5, 1}}};
  EXPECT_DOUBLE_EQ(ray_length(layout, {0, 0, 0.5}, {1, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(ray_length(layout, {0, 0, 0.5}, {0.5, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(ray_length(layout, {0, 0, 1.5}, {1, 0, 0}), 3);
  EXPECT_DOUBLE_EQ(ray_length(layout, {0, 0, 0.5}, {-1, 0, 0}), 3) << "the box is behind";
  EXPECT_DOUBLE_EQ(ray_length(layout, {0, 0, 0.5}, {0, 0, -1}), 0.5);
}

TEST(ImageGain, ScalesAndClips) {
  Image image(16, 16, 100);
  image(3, 4) = 0, image(5, 6) = 240;
  apply_gain(image, 1.5);
  EXPECT_EQ(image(0, 0), 150);
  EXPECT_EQ(image(3, 4), 0);
  EXPECT_EQ(image(5, 6), 255);
  apply_gain(image, 0.5);
  EXPECT_EQ(image(0, 0), 75);
}

TEST(ExposureGain, StepsAtGivenTimes) {
  ExposureGain gain({.step_ratio = 1.5, .step_times_s = {1, 2, 5}}, 1, "steps");
  EXPECT_EQ(gain.at(0), 1);
  EXPECT_EQ(gain.at(0.99), 1);
  EXPECT_EQ(gain.at(1), 1.5);
  EXPECT_EQ(gain.at(1.9), 1.5);
  EXPECT_EQ(gain.at(3), 1);
  EXPECT_EQ(gain.at(100), 1.5);
}

TEST(ExposureGain, StepsAtRandomTimesWithinItsRatio) {
  const ExposureSettings settings{.step_ratio = 2, .step_interval_s = 0.5};
  ExposureGain gain(settings, 1, "steps"), again(settings, 1, "steps"), other(settings, 2, "steps");
  double last = 1, least = 1, most = 1;
  int steps = 0, different = 0;
  for (double t = 0; t < 100; t += 0.01) {
    const double now = gain.at(t);
    EXPECT_EQ(now, again.at(t));
    different += now != other.at(t);
    steps += now != last;
    last = now, least = std::min(least, now), most = std::max(most, now);
  }
  EXPECT_NEAR(steps, 200, 50);
  EXPECT_GE(least, 0.5);
  EXPECT_LE(most, 2);
  EXPECT_LT(least, 0.6);
  EXPECT_GT(most, 1.6);
  EXPECT_GT(different, 9000);
}

TEST(ExposureGain, WithoutARatioNeverSteps) {
  ExposureGain gain({}, 1, "steps");
  EXPECT_EQ(gain.at(1e6), 1);
  EXPECT_THROW(ExposureGain({.step_ratio = 0.5}, 1, "steps"), std::invalid_argument);
  EXPECT_THROW(ExposureGain({.step_ratio = 2, .step_times_s = {2, 1}}, 1, "steps"), std::invalid_argument);
}

/// A camera whose motion is not given moves as velocity and rate of its true state say.
TEST(RoomCamera, BlursByTheVelocityOfTheTruth) {
  RoomSettings quiet;
  quiet.sigma_image_gray = 0;
  BodyTruth body{start()};
  body.state = SmallVector::Zero(FreeCameraMotion::state_size);
  body.state.head<10>() << start().position, start().world_from_body, 0, 0.7, 0;
  RoomCamera camera(room(), lens, quiet, 1, "sensor.image", {.duration_s = 0.04, .readout_s = 0.02});
  BodyObservation observation;
  camera.measure(Truth{{body}}, 0, Tick{0, 0, 0}, observation);
  EXPECT_EQ(*observation.images.at(0), exposed(moving({0, 0.7, 0}), 0.04, 0.02));
  camera.follow([](double t) { return extrapolated({start(), {0, -0.3, 0}, {0, 0, 0}}, t - 2); });
  camera.measure(Truth{{body}}, 0, Tick{1, 2, 0}, observation);
  EXPECT_EQ(*observation.images.at(1), exposed(moving({0, -0.3, 0}), 0.04, 0.02));
}

}  // namespace
}  // namespace incognita
