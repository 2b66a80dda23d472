// The parts of the loop go on from a saved state with the same bits, each built anew from its configuration.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/messages/saved_messages.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/mapper/saved_estimate.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/points/point_world.hpp"
#include "incognita/world/rendered/room_bodies.hpp"
#include "incognita/world/rendered/room_camera.hpp"

namespace incognita {
namespace {

struct Parts {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<World> world;
  std::unique_ptr<Sensor> sensors;
  std::unique_ptr<SlamEstimator> estimator;
  std::unique_ptr<Strategy> strategy;
  std::unique_ptr<Controller> controller;
  Estimate estimate = {};
  Command command = {};

  void run(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      const Tick tick = clock->next();
      const auto truth = world->move(command, tick);
      const Observation observation = sensors->measure(truth, tick);
      estimator->update(estimate, command, observation, tick);
      const Goal goal = strategy->choose(estimate, observation, tick);
      command = controller->act(estimate, goal, observation, tick);
    }
  }

  void state(StateArchive& archive) {
    estimate_state(archive, estimate);
    archive(command);
    for (SavedPart* part : std::vector<SavedPart*>{clock.get(), world.get(), sensors.get(), estimator.get(),
                                                   strategy.get(), controller.get()})
      part->state(archive);
  }
};

std::string saved(Parts& parts) {
  StateWriter writer;
  StateArchive{writer}(parts);
  return writer.take();
}

void restore(const std::string& bytes, Parts& parts) {
  StateReader reader(bytes);
  StateArchive{reader}(parts);
  EXPECT_EQ(reader.left(), 0u);
}

void expect_goes_on(const std::function<Parts()>& built, int before, int after) {
  Parts whole = built();
  whole.run(before);
  const std::string bytes = saved(whole);
  Parts resumed = built();
  restore(bytes, resumed);
  EXPECT_TRUE(saved(resumed) == bytes);
  whole.run(after);
  resumed.run(after);
  EXPECT_GT(whole.estimate.landmarks.size(), 3u);
  EXPECT_TRUE(saved(whole) == saved(resumed));
}

/// A camera without a target that explores a room.
Parts exploring(DecisionSettings::Strategy strategy = DecisionSettings::Strategy::mutual_information) {
  constexpr std::uint64_t seed = 3;
  RoomSettings settings;
  settings.start_position_m = {0.5, 0, 1.3};
  const Camera camera{WideAngleCamera{}};
  const auto room = std::make_shared<const Room>(settings, seed);
  CameraSlamSettings slam;
  slam.map.wanted_visible = 15;
  Parts parts;
  parts.clock = std::make_unique<FixedRateClock>(30, 100);
  parts.world = std::make_unique<SimulatedWorld>(camera_in_room(settings, room->layout(), seed), seed);
  ExposureSettings exposure;
  exposure.step_ratio = 1.5;
  exposure.step_interval_s = 0.3;
  parts.sensors = std::make_unique<SensorSet>(
      sensors_of_body(std::make_unique<RoomCamera>(room, camera, settings, seed, "sensor.image", exposure)));
  parts.estimator = std::make_unique<SlamEstimator>(single_camera(camera, {}, slam, 10, seed));
  ActiveSettings active;
  active.decision.strategy = strategy;
  active.decision.period_s = 0.4;
  active.decision.min_bound_m = {-2.5, -2.5, 0.4};
  active.decision.max_bound_m = {2.5, 2.5, 2.1};
  active.exploration.expected_landmarks = 60;
  active.exploration.max_m = {3, 3, 2.5};
  active.exploration.min_m = {-3, -3, 0};
  active.tick_s = 1.0 / 30;
  parts.strategy = decide_for(*parts.estimator, active);
  parts.controller = std::make_unique<SteeringController>(std::vector{free_camera_control({})}, 1.0 / 30);
  return parts;
}

TEST(SavedParts, ACameraThatExploresARoom) {
  expect_goes_on([] { return exploring(); }, 25, 20);
}

/// The routes that they follow, what stopped them, and the cells that they pursue.
TEST(SavedParts, ACameraByStrategiesThatAreRules) {
  using Strategy = DecisionSettings::Strategy;
  for (const Strategy strategy : {Strategy::lawn_mower, Strategy::wall_follower, Strategy::frontier})
    expect_goes_on([strategy] { return exploring(strategy); }, 25, 25);
}

/// Two robots on the plane that choose where to drive, with or without identities of what they measure.
Parts driving(DataAssociationSettings::Method association) {
  constexpr std::uint64_t seed = 5;
  PointLandmarks posts;
  for (int i = 0; i < 12; ++i)
    posts[i] = SmallVector(Eigen::Vector2d(4 * std::cos(0.5 * i), 4 * std::sin(0.5 * i)));
  EstimatorSettings settings;
  settings.association.method = association;
  std::vector<SimulatedVehicle> vehicles;
  std::vector<BodyControl> controls;
  for (const double y : {-1.0, 1.0}) {
    const BodyModel body = body_with_sensor(DifferentialDrive{}, RangeBearingSensor{},
                                            Eigen::Vector3d(0, y, 0), Eigen::Vector3d(0.01, 0.01, 0.01),
                                            Eigen::Vector2d(0.05, 0.05), Eigen::Vector2d(0.05, 0.01));
    settings.bodies.push_back(body);
    SteeringSettings steering;
    steering.law = ControlLaw::none;
    steering.most_input = SmallVector(Eigen::Vector2d(1, 1));
    steering.input = SmallVector(Eigen::Vector2d(0.4, 0.1 * y));
    controls.push_back({body.motion, steering});
    SimulatedVehicle vehicle{
        {body.motion,
         {body.start, body.start_sigmas, body.input_sigmas, -steering.most_input, steering.most_input},
         {}},
        {body.sensors[0].sensor, body.sensors[0].sigmas}};
    vehicle.sensor.limits.max_range_m = 6;
    vehicle.sensor.ticks_per_measurement = 2;
    vehicles.push_back(vehicle);
  }
  Parts parts;
  parts.clock = std::make_unique<FixedRateClock>(10, 100);
  parts.world = std::make_unique<SimulatedWorld>(point_world(vehicles, seed));
  PointTargets targets{posts, true, {}};
  if (association != DataAssociationSettings::Method::known) targets.identified.emplace();
  parts.sensors = std::make_unique<SensorSet>(point_sensors(vehicles, targets, seed));
  parts.estimator = std::make_unique<SlamEstimator>(settings);
  parts.strategy = std::make_unique<NoDecision>();
  parts.controller = std::make_unique<SteeringController>(controls, 0.1);
  return parts;
}

TEST(SavedParts, TwoRobots) {
  expect_goes_on([] { return driving(DataAssociationSettings::Method::known); }, 31, 60);
}
TEST(SavedParts, TwoRobotsWithoutIdentities) {
  expect_goes_on([] { return driving(DataAssociationSettings::Method::nearest); }, 32, 60);
}

}  // namespace
}  // namespace incognita
