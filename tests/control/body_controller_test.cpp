// Low-level control of a vehicle with a camera: a commanded drive takes precedence over the law, and obstacle
// avoidance applies to both.
#include "incognita/control/steering_controller.hpp"

#include <gtest/gtest.h>

#include "incognita/models/motion/terrain_vehicle.hpp"

namespace incognita {
namespace {

const Mount mount{0.2, -0.1, 0.8, -0.3, 0.4};

BodyControl driving(ControlLaw law = ControlLaw::none) {
  BodyControl d{TerrainVehicle{}, {}};
  d.steering.law = law;
  d.steering.input = SmallVector(Eigen::Vector2d(0.2, 0.1));
  d.steering.most_input = SmallVector(Eigen::Vector2d(0.5, 0.6));
  d.carried_at = mount;
  return d;
}

Estimate at(const TerrainVehicle& vehicle, const Eigen::Vector3d& x) {
  Estimate estimate;
  Body& body = estimate.bodies.emplace_back();
  body.state = mount.on(vehicle.pose(x)).camera;
  body.block = estimate.belief.add_vehicle(FreeCameraMotion::chart, body.state,
                                           1e-4 * FreeCameraMotion::Jacobian::Identity());
  estimate.started = true;
  estimate.status.state = TrackingState::tracking;
  return estimate;
}

TEST(CarriedCamera, FindsTheAxleUnderTheCamera) {
  const TerrainVehicle vehicle{Waves{0, {{0.1, 2, 0.3, 0.2}, {0.08, 1.4, 1.8, 1}}}};
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.3, -0.2, 0.5), Eigen::Vector3d(-1, 2, -3)}) {
    const Estimate estimate = at(vehicle, x);
    EXPECT_LT((axle_under(estimate.camera_state(), mount) - x).norm(), 1e-12);
  }
}

Eigen::Vector2d input(const Command& command) { return input_of(command_of(command, 0), 2); }

TEST(CarriedCamera, CommandedDriveTakesPrecedenceOverTheLaw) {
  SteeringController controller({driving()}, 0.1);
  const Estimate estimate = at({}, {0, 0, 0});
  EXPECT_EQ(input(controller.act(estimate, {}, {}, {0, 0, 0})), Eigen::Vector2d(0.2, 0.1));
  Goal goal;
  goal.bodies.resize(1);
  goal.bodies[0].drive = Eigen::Vector2d(-0.3, 0.2);
  EXPECT_EQ(input(controller.act(estimate, goal, {}, {1, 0.1, 0.1})), Eigen::Vector2d(-0.3, 0.2));
  goal.bodies[0].drive = Eigen::Vector2d(5, 0.6);  // the same direction, up to the limits
  EXPECT_LT((input(controller.act(estimate, goal, {}, {2, 0.2, 0.1})) - Eigen::Vector2d(0.5, 0.06)).norm(),
            1e-12);
}

TEST(CarriedCamera, CommandsZeroBeforeTheStartAndWhenLost) {
  SteeringController controller({driving()}, 0.1);
  EXPECT_EQ(input(controller.act({}, {}, {}, {0, 0, 0})), Eigen::Vector2d(0, 0));
  Estimate estimate = at({}, {0, 0, 0});
  estimate.status.state = TrackingState::lost;
  EXPECT_EQ(input(controller.act(estimate, {}, {}, {1, 0.1, 0.1})), Eigen::Vector2d(0, 0));
}

TEST(CarriedCamera, AvoidsObstaclesUnderAnyCommand) {
  BodyControl d = driving();
  d.obstacle_avoidance = ObstacleAvoidanceSettings{0.8, 0.3, {0.5, 0.6}};
  SteeringController controller({d}, 0.1);
  Observation observation;
  observation.bodies.resize(1);
  observation.bodies[0].proximity_ranges.push_back({0, 0.1, 0.3});
  Goal goal;
  goal.bodies.resize(1);
  goal.bodies[0].drive = Eigen::Vector2d(0.5, 0);
  const Eigen::Vector2d u = input(controller.act(at({}, {0, 0, 0}), goal, observation, {0, 0, 0}));
  EXPECT_NEAR(u[0], 0, 1e-12);
  EXPECT_NEAR(std::abs(u[1]), 0.6, 1e-12);
}

TEST(CarriedCamera, FollowsAPathOnUnevenGround) {
  const TerrainVehicle vehicle{Waves{0, {{0.06, 2, 0.3, 0.2}}}};
  BodyControl d = driving(ControlLaw::feedback_linearization);
  d.steering.path = CirclePath{{0, 0, 0}, 1, 0.2, 0};
  SteeringController controller({d}, 0.05);
  Eigen::Vector3d x(0.8, 0, 1.2);
  for (int k = 0; k < 1200; ++k) {
    const Command command = controller.act(at(vehicle, x), {}, {}, {k, 0.05 * k, 0.05});
    x = vehicle.f<double>(x, input(command), 0.05);
  }
  const Eigen::Vector2d front = x.head<2>() + 0.2 * Eigen::Vector2d(std::cos(x[2]), std::sin(x[2]));
  const double t = 1200 * 0.05;
  EXPECT_LT((front - Eigen::Vector2d(std::cos(0.2 * t), std::sin(0.2 * t))).norm(), 0.05);
}

TEST(CarriedCamera, RefusesInvalidSettings) {
  BodyControl d = driving(ControlLaw::lqg);
  EXPECT_THROW(SteeringController({d}, 0.1), std::invalid_argument);
  d = driving();
  d.obstacle_avoidance = ObstacleAvoidanceSettings{0.2, 0.3, {0.5, 0.6}};
  EXPECT_THROW(SteeringController({d}, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
