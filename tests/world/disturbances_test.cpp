// Disturbances of the simulated world and of images.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "incognita/models/motion/heading.hpp"
#include "incognita/world/disturbed_images.hpp"
#include "incognita/world/replay/replay.hpp"
#include "incognita/world/simulated_world.hpp"

namespace incognita {
namespace {

SimulatedBody body_of(AnyMotion motion, const SmallVector& start) {
  const Eigen::Index errors = chart_of(motion).tangent(), inputs = inputs_of(motion);
  SimulatedBody body{std::move(motion), {}, "body"};
  body.plant.start = start;
  body.plant.start_sigmas = SmallVector::Zero(errors);
  body.plant.input_sigmas = SmallVector::Zero(inputs);
  body.plant.most_input = SmallVector::Constant(inputs, 10);
  body.plant.least_input = -body.plant.most_input;
  return body;
}

SmallVector at_rest_in_space() { return at_rest(FreeCameraMotion{}, {1, 2, 3}, 0.5); }

/// The state after `ticks` ticks of 0.1 s without a command.
SmallVector state_after(SimulatedWorld& world, int ticks, std::size_t body = 0) {
  SmallVector state;
  for (int k = 0; k < ticks; ++k) state = world.move({}, {k, 0.1 * k, 0.1})->bodies.at(body).state;
  return state;
}

TEST(Disturbances, ADisplacedVehicleIsElsewhere) {
  SimulatedWorld world(body_of(DifferentialDrive{}, SmallVector(Eigen::Vector3d(1, 2, 3))), 1);
  world.displace({0, {0.5, -0.25, 7}, 1});
  const SmallVector state = state_after(world, 1);
  EXPECT_NEAR(state[0], 1.5, 1e-9);
  EXPECT_NEAR(state[1], 1.75, 1e-9);
  EXPECT_NEAR(state[2], 4 - 2 * std::numbers::pi, 1e-9);
}

TEST(Disturbances, ADisplacedCameraKeepsItsVelocityAndTilt) {
  SmallVector start = at_rest_in_space();
  start[7] = 0.2;
  SimulatedWorld world(body_of(FreeCameraMotion{}, start), 1);
  world.displace({0, {0, 0, 0.5}, 0.25});
  const SmallVector state = state_after(world, 1);
  EXPECT_NEAR(state[2], 3.5, 1e-9);
  EXPECT_NEAR(state[7], 0.2, 1e-9);
  EXPECT_NEAR(heading_of(state.segment<4>(3)), 0.75, 1e-9);
  EXPECT_NEAR(state.segment<4>(3).norm(), 1, 1e-12);
}

TEST(Disturbances, APushLastsItsTime) {
  SimulatedWorld world(body_of(DifferentialDrive{}, SmallVector(Eigen::Vector3d(0, 0, 0))), 1);
  world.push({0, {0, 2, 0}, 0.25});
  EXPECT_NEAR(state_after(world, 2)[1], 0.4, 1e-9);
  EXPECT_NEAR(state_after(world, 3)[1], 0.5, 1e-9);
}

/// Nothing on board measures a push: odometry is the executed input.
TEST(Disturbances, APushIsNotInTheInput) {
  SimulatedWorld world(body_of(DifferentialDrive{}, SmallVector(Eigen::Vector3d(0, 0, 0))), 1);
  world.push({0, {1, 1, 0}, 1});
  EXPECT_EQ(world.move({}, {0, 0, 0.1})->bodies.at(0).input, SmallVector(SmallVector::Zero(2)));
}

TEST(Disturbances, AMotionOnALineHasOneCoordinate) {
  const MonobotMotion monobot;
  SimulatedWorld world(body_of(monobot, SmallVector::Zero(chart_of(monobot).ambient())), 1);
  world.displace({0, {0.5, 3, 3}, 1});
  EXPECT_NEAR(state_after(world, 1)[0], 0.5, 1e-9);
}

/// Stops a body at x = 1.
struct Wall : Obstacles {
  void check_start(const SmallVector&) const override {}
  bool stop(const SmallVector&, SmallVector& state) const override {
    if (state[0] <= 1) return false;
    state[0] = 1;
    return true;
  }
};

TEST(Disturbances, ObstaclesStopThem) {
  SimulatedBody body = body_of(DifferentialDrive{}, SmallVector(Eigen::Vector3d(0, 0, 0)));
  body.obstacles = std::make_shared<Wall>();
  SimulatedWorld world(std::move(body), 1);
  world.displace({0, {3, 0, 0}, 0});
  EXPECT_EQ(state_after(world, 1)[0], 1);
  world.push({0, {5, 0, 0}, 1});
  EXPECT_EQ(state_after(world, 3)[0], 1);
}

TEST(Disturbances, NeedABodyAndASimulation) {
  SimulatedWorld world(body_of(DifferentialDrive{}, SmallVector(Eigen::Vector3d(0, 0, 0))), 1);
  EXPECT_THROW(world.displace({1, {0, 0, 0}, 0}), std::invalid_argument);
  EXPECT_THROW(world.push({1, {0, 0, 0}, 1}), std::invalid_argument);
  ReplayWorld recorded({});
  EXPECT_THROW(recorded.displace({}), std::invalid_argument);
  EXPECT_THROW(recorded.push({}), std::invalid_argument);
}

/// Gray 100 everywhere.
struct GrayCamera : Sensor {
  Observation measure(const std::optional<Truth>&, const Tick&) override {
    Observation observation;
    observation.bodies.resize(1);
    observation.bodies[0].images.push_back(std::make_shared<const Image>(64, 48, std::uint8_t{100}));
    return observation;
  }
};

struct Pixels {
  double mean = 0, sigma = 0;
};

Pixels seen(DisturbedImages& images) {
  const auto image = images.measure({}, {}).bodies.at(0).images.at(0);
  double sum = 0, squares = 0;
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) sum += (*image)(u, v), squares += (*image)(u, v) * (*image)(u, v);
  const double mean = sum / (64 * 48);
  return {mean, std::sqrt(squares / (64 * 48) - mean * mean)};
}

TEST(DisturbedImages, AreThoseOfTheSensorAtFirst) {
  DisturbedImages images(std::make_unique<GrayCamera>(), 1);
  EXPECT_EQ(seen(images).mean, 100);
  EXPECT_EQ(seen(images).sigma, 0);
}

TEST(DisturbedImages, AreDarkUnderACover) {
  DisturbedImages images(std::make_unique<GrayCamera>(), 1);
  images.cover({true});
  EXPECT_LT(seen(images).mean, 20);
  images.cover({false});
  EXPECT_EQ(seen(images).mean, 100);
}

TEST(DisturbedImages, HaveTheAddedNoise) {
  DisturbedImages images(std::make_unique<GrayCamera>(), 1);
  images.add_noise({10});
  const Pixels noisy = seen(images);
  EXPECT_NEAR(noisy.sigma, 10, 1);
  EXPECT_NEAR(noisy.mean, 100, 1);
  images.add_noise({0});
  EXPECT_EQ(seen(images).sigma, 0);
  EXPECT_THROW(images.add_noise({-1}), std::invalid_argument);
  EXPECT_THROW(images.add_noise({101}), std::invalid_argument);
}

TEST(DisturbedImages, FollowTheLight) {
  DisturbedImages images(std::make_unique<GrayCamera>(), 1);
  images.change_light({0.5});
  EXPECT_EQ(seen(images).mean, 50);
  images.change_light({5});
  EXPECT_EQ(seen(images).mean, 255);
  EXPECT_THROW(images.change_light({-0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
