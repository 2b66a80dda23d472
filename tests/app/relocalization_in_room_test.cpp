// A camera that maps the rendered room in closed loop, and is carried to places that it saw before or to another room.
// 200 trials: bench/relocalization_trials.cpp.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

/// The loop, one tick at a time.
struct Room {
  Assembly assembly;
  Estimate estimate = {};
  Command command = {};
  RigidPose truth = {};
  double t = 0;

  explicit Room(const char* seed) : assembly(assemble(load_scenario("explore-room", sets(seed)))) {}
  static std::vector<std::string> sets(const char* seed) {
    return {std::string("run.seed=") + seed, "run.duration_s=40", "decision.gaze_rate_rad_s=0.3"};
  }

  void step(Sensor& sensor) {
    LoopParts& parts = assembly.parts;
    const Tick tick = parts.clock->next();
    t = tick.t;
    const std::optional<Truth> true_state = parts.world->move(command, tick);
    truth = *true_state->bodies[0].pose;
    const Observation observation = sensor.measure(true_state, tick);
    parts.estimator->update(estimate, command, observation, tick);
    const Goal goal = parts.strategy->choose(estimate, observation, tick);
    command = parts.controller->act(estimate, goal, observation, tick);
  }
  void step() { step(*assembly.parts.sensor); }
  bool is_lost() const { return estimate.status.state == TrackingState::lost; }

  void carry_to(const RigidPose& there) {
    assembly.parts.world->displace({0, there.position - truth.position,
                                    heading_of(there.world_from_body) - heading_of(truth.world_from_body)});
  }
  Eigen::Matrix<double, 6, 1> error() const {
    CameraState true_camera = CameraState::Zero();
    true_camera << truth.position, truth.world_from_body, Eigen::Matrix<double, 6, 1>::Zero();
    const CameraState x = estimate.camera_state();
    Eigen::Matrix<double, 12, 1> e;
    FreeCameraMotion::chart.minus({true_camera.data(), 13}, {x.data(), 13}, {e.data(), 12});
    return e.head<6>();
  }
};

TEST(RelocalizationInRoom, IsBackWhereItWasAndNotInAnotherRoom) {
  Room room("1");
  std::vector<RigidPose> seen;
  for (int frame = 0; room.t < 22; ++frame) {
    room.step();
    if (frame % 75 == 60) seen.push_back(room.truth);
  }
  ASSERT_EQ(room.estimate.status.state, TrackingState::tracking);
  for (const std::size_t place : {0u, 3u, 1u}) {
    room.carry_to(seen.at(place));
    for (int i = 0; i < 15 && !room.is_lost(); ++i) room.step();
    ASSERT_TRUE(room.is_lost()) << "place " << place;
    const double lost_t = room.t;
    while (room.is_lost() && room.t < lost_t + 2) room.step();
    ASSERT_EQ(room.estimate.status.state, TrackingState::relocated) << "place " << place;
    const Eigen::Matrix<double, 6, 1> e = room.error();
    EXPECT_LT(e.head<3>().norm(), 0.2) << "place " << place;
    EXPECT_LT(e.tail<3>().norm(), 0.05) << "place " << place;
    const Eigen::Matrix<double, 6, 6> P = room.estimate.body().pose_covariance;
    EXPECT_LT(e.dot(P.llt().solve(e)), 30) << "6 degrees of freedom; place " << place;
    for (int i = 0; i < 8; ++i) {
      room.step();
      EXPECT_FALSE(room.is_lost()) << "place " << place;
    }
  }
  const Assembly other = assemble(load_scenario("explore-room", Room::sets("77")));
  for (int i = 0; i < 15; ++i) room.step(*other.parts.sensor);
  for (int i = 0; i < 15; ++i) {
    room.step(*other.parts.sensor);
    EXPECT_TRUE(room.is_lost()) << i;
  }
}

/// Few of the features that are searched match by chance after a displacement, and must not correct the filter: it would track
/// what is not there.
TEST(RelocalizationInRoom, IsNotTrackedElsewhereAfterADisplacement) {
  Room room("1");
  while (room.t < 20) room.step();
  const RigidPose home = room.truth;
  RandomStream random(1, "test.displacement");
  int moved = 0;
  for (int i = 0; i < 8; ++i) {
    RigidPose there = home;
    there.position.head<2>() = Eigen::Vector2d(random.uniform(-2, 2), random.uniform(-2, 2));
    there.world_from_body = level_gaze(random.uniform(-3, 3));
    room.carry_to(there);
    for (int frame = 0; frame < 20; ++frame) room.step();
    const double error_m = room.error().head<3>().norm();
    EXPECT_TRUE(room.is_lost() || error_m < 0.3) << i << ", off by " << error_m << " m";
    room.carry_to(home);
    for (int frame = 0; frame < 40 && (frame < 3 || room.is_lost()); ++frame) room.step();
    moved += !room.is_lost();
  }
  EXPECT_GE(moved, 6) << "back at home";
}

}  // namespace
}  // namespace incognita
