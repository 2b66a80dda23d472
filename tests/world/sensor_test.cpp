#include <gtest/gtest.h>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/image_noise.hpp"
#include "incognita/world/rendered/render.hpp"
#include "incognita/world/rendered/room_camera.hpp"

using namespace incognita;

namespace {

const std::shared_ptr<const Room>& sensed_room() {
  static const auto shared = std::make_shared<const Room>(RoomSettings{}, 1);
  return shared;
}

RigidPose start() { return {{1.6, 0, 1.3}, level_gaze(0)}; }

struct Moments {
  double mean = 0, sigma = 0;
};

Moments moments(const Image& image) {
  const int count = image.width() * image.height();
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    sum += image.row(0)[i];
    squares += image.row(0)[i] * image.row(0)[i];
  }
  return {sum / count, std::sqrt(squares / count - sum / count * sum / count)};
}

TEST(ImageNoise, HasTheStatedSigmaAndNoBias) {
  for (const double sigma : {1.0, 2.0, 7.5}) {
    ImageNoise noise(sigma, 3);
    Image image(320, 240, 128);
    noise.add_to(image);
    const Moments m = moments(image);
    EXPECT_NEAR(m.mean, 128, 5 * sigma / std::sqrt(320.0 * 240));
    EXPECT_NEAR(m.sigma, std::sqrt(sigma * sigma + 1.0 / 12), 0.02 * sigma)
        << "including rounding to integer levels";
  }
}

TEST(ImageNoise, RowsAndFramesDoNotRepeat) {
  ImageNoise noise(2, 3);
  Image image(320, 240, 128), next = image;
  noise.add_to(image);
  noise.add_to(next);
  EXPECT_NE(image, next);
  for (int v = 1; v < 240; ++v)
    ASSERT_FALSE(std::equal(image.row(v), image.row(v) + 320, image.row(v - 1))) << v;
}

TEST(ImageNoise, StaysBetweenBlackAndWhite) {
  ImageNoise noise(50, 3);
  Image black(64, 64, 0), white(64, 64, 255);
  noise.add_to(black);
  noise.add_to(white);
  EXPECT_NEAR(moments(black).mean, 50 / std::sqrt(2 * 3.14159), 2)
      << "half a normal distribution, without wrapping";
  EXPECT_NEAR(moments(white).mean, 255 - 50 / std::sqrt(2 * 3.14159), 2);
  EXPECT_THROW(ImageNoise(-1, 3), std::invalid_argument);
}

TEST(RoomCamera, IsTheRenderPlusNoise) {
  const WideAngleCamera model{.kd1 = 9e-6};
  RoomSettings quiet;
  quiet.sigma_image_gray = 0;
  Image expected;
  render(*sensed_room(), RayTable{Camera(model)}, {1.6, 0, 1.3}, level_gaze(0), expected);
  EXPECT_EQ(*RoomCamera(sensed_room(), model, quiet, 1).image_from(start(), Tick{0, 0, 0}), expected);

  const Image noisy = *RoomCamera(sensed_room(), model, RoomSettings{}, 1).image_from(start(), Tick{0, 0, 0});
  double squares = 0;
  int count = 0;
  for (int i = 0; i < 320 * 240; ++i)
    if (const int e = expected.row(0)[i]; e > 20 && e < 235) {
      squares += (noisy.row(0)[i] - e) * (noisy.row(0)[i] - e);
      ++count;
    }
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(4 + 1.0 / 12), 0.05);
}

TEST(RoomCamera, SameSeedSameBytesAndAnotherSeedOthers) {
  const auto bytes = [](std::uint64_t seed) {
    RoomCamera camera(sensed_room(), WideAngleCamera{}, RoomSettings{}, seed);
    camera.image_from(start(), Tick{0, 0, 0});
    return *camera.image_from(start(), Tick{1, 0.1, 0.1});
  };
  EXPECT_EQ(bytes(8), bytes(8));
  EXPECT_NE(bytes(8), bytes(9));
}

TEST(RoomCamera, ACoveredLensIsDarkFromThenOn) {
  RoomSettings s;
  s.cover_lens_from_s = 2;
  RoomCamera camera(sensed_room(), WideAngleCamera{}, s, 1);
  EXPECT_GT(moments(*camera.image_from(start(), Tick{59, 59 / 30.0, 1 / 30.0})).mean, 60);
  for (const double t : {2.0, 2.5, 100.0}) {
    const Moments m = moments(*camera.image_from(start(), Tick{60, t, 1 / 30.0}));
    EXPECT_LT(m.mean, 12);
    EXPECT_NEAR(m.sigma, 2, 0.2) << "noise goes on";
  }
}

TEST(RoomCamera, NeedsTheTruth) {
  SensorSet sensors(
      sensors_of_body(std::make_unique<RoomCamera>(sensed_room(), WideAngleCamera{}, RoomSettings{}, 1)));
  EXPECT_THROW(sensors.measure(std::nullopt, Tick{0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(sensors.measure(Truth{{BodyTruth{}}}, Tick{0, 0, 0}), std::invalid_argument);
}

/// A body carries any set of sensors: here two cameras, of which the second lies 1 px beside the first.
TEST(SensorSet, ABodyMayCarrySeveralCameras) {
  RoomSettings quiet;
  quiet.sigma_image_gray = 0;
  WideAngleCamera first, second;
  second.u0 += 1;
  SensorSet sensors(sensors_of_body(std::make_unique<RoomCamera>(sensed_room(), first, quiet, 1),
                                    std::make_unique<RoomCamera>(sensed_room(), second, quiet, 1)));
  const Observation observation = sensors.measure(Truth{{BodyTruth{start()}}}, Tick{0, 0, 0});
  ASSERT_EQ(observation.bodies.size(), 1u);
  ASSERT_EQ(observation.bodies[0].images.size(), 2u);
  EXPECT_NE(*observation.bodies[0].images[0], *observation.bodies[0].images[1]);
}

TEST(FixedRateClock, TicksSteadilyAndEnds) {
  FixedRateClock clock(30, 2);
  EXPECT_EQ(clock.expected_frames(), 60);
  int frames = 0;
  double t = 0;
  while (const Tick tick = clock.next()) {
    EXPECT_EQ(tick.frame, frames);
    EXPECT_DOUBLE_EQ(tick.dt, frames == 0 ? 0 : 1.0 / 30);
    t += tick.dt;
    EXPECT_NEAR(tick.t, t, 1e-9);
    ++frames;
  }
  EXPECT_EQ(frames, 60);
  EXPECT_FALSE(clock.next()) << "once ended, it stays so";
  EXPECT_THROW(FixedRateClock(0, 1), std::invalid_argument);
  EXPECT_THROW(FixedRateClock(30, NAN), std::invalid_argument);
  EXPECT_THROW(FixedRateClock(30, 1e300), std::invalid_argument);
}

}  // namespace
