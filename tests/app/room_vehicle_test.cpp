// A vehicle with a camera on uneven ground in the rendered room, from its scenario to a run.
#include <gtest/gtest.h>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/control/body_controller.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/app/share_within_three_sigma.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

struct Ran {
  int frames = 0, lost = 0;
  double rms_m = 0, sigma_speed = 0, height_span_m = 0, farthest_m = 0;
  Snapshot last;
};

Ran run(const LoadedScenario& loaded) {
  Assembly assembly = assemble(loaded);
  Ran ran;
  double low = 1e9, high = -1e9;
  const auto publish = [&](const Snapshot& s) {
    ran.last = s;
    ++ran.frames;
    ran.lost += s.status.state == TrackingState::lost || s.status.state == TrackingState::starting;
    const StampedPose &truth = *s.bodies[0].truth, &estimate = s.bodies[0].estimate;
    ran.rms_m += (estimate.position - truth.position).squaredNorm();
    CameraState camera = CameraState::Zero();
    camera.head<7>() << truth.position, truth.orientation;
    const Eigen::Vector3d axle = axle_under(camera, loaded.scenario.mount);
    ran.farthest_m = std::max(ran.farthest_m, axle.head<2>().cwiseAbs().maxCoeff());
    low = std::min(low, truth.position.z());
    high = std::max(high, truth.position.z());
  };
  const auto watch = [&](const Estimate& e) {
    if (e.started) ran.sigma_speed += std::sqrt(e.body().state_covariance.diagonal().segment<3>(6).sum());
  };
  run_loop(
      assembly.parts, publish, [](const Tick&) { return true; }, watch);
  ran.rms_m = std::sqrt(ran.rms_m / ran.frames);
  ran.sigma_speed /= ran.frames;
  ran.height_span_m = high - low;
  return ran;
}

Ran drive(const std::vector<std::string>& sets) { return run(load_scenario("rendered-terrain", sets)); }

TEST(RoomVehicle, LocalizesByImagesOnUnevenGround) {
  const Ran ran = drive({"run.duration_s=8"});
  EXPECT_EQ(ran.frames, 240);
  EXPECT_EQ(ran.lost, 0);
  EXPECT_LT(ran.rms_m, 0.05);
  EXPECT_GT(ran.height_span_m, 0.03) << "the ground is level";
  EXPECT_GT(ran.last.landmarks.size(), 10u);
}

/// Without bundle adjustment it was 0.44 m off, and overconfident.
TEST(RoomVehicle, BundleAdjustmentKeepsItsMapFromBending) {
  const Ran ran = run(load_scenario("explore-terrain", std::vector<std::string>{"run.seed=104"}));
  EXPECT_EQ(ran.lost, 0);
  EXPECT_LT(ran.rms_m, 0.15);
}

/// Images do not show a turn of the whole world. With the usual errors the filter takes the motion of its means for such a view.
TEST(RoomVehicle, InvariantErrorsKeepItsMapConsistent) {
  const auto within_3_sigma = [](const char* invariant) {
    const Ran ran = run(load_scenario(
        "map-terrain", std::vector<std::string>{"run.seed=3", "run.duration_s=12",
                                                std::string("estimator.invariant=") + invariant}));
    EXPECT_EQ(ran.lost, 0);
    return share_within_three_sigma(ran.last);
  };
  EXPECT_GT(within_3_sigma("true"), 0.95);
  EXPECT_LT(within_3_sigma("false"), 0.5);
}

TEST(RoomVehicle, OdometryReducesTheSpeedSigma) {
  const Ran images = drive({"run.duration_s=4"}),
            wheels = drive({"run.duration_s=4", "estimator.use_odometry=true"});
  EXPECT_EQ(wheels.lost, 0);
  EXPECT_LT(wheels.rms_m, 0.05);
  EXPECT_LT(wheels.sigma_speed, 0.7 * images.sigma_speed);
}

TEST(RoomVehicle, SameSeedSameRun) {
  const Ran one = drive({"run.duration_s=2"}), two = drive({"run.duration_s=2"});
  EXPECT_EQ(one.last.bodies[0].estimate.position, two.last.bodies[0].estimate.position);
  EXPECT_EQ(one.last.bodies[0].covariance, two.last.bodies[0].covariance);
}

TEST(RoomVehicle, DecidesDeterministically) {
  const auto explored = [](const std::vector<std::string>& sets) {
    return run(load_scenario("explore-terrain", sets));
  };
  const Ran ran = explored({"run.duration_s=5", "run.rate_hz=15"}),
            again = explored({"run.duration_s=5", "run.rate_hz=15"});
  EXPECT_EQ(ran.lost, 0);
  EXPECT_EQ(ran.last.bodies.at(0).decision.actions.size(), 7u);
  EXPECT_GE(ran.last.bodies.at(0).decision.chosen, 0);
  EXPECT_GT(ran.last.coverage.value_or(0), 0.05);
  EXPECT_LT(ran.rms_m, 0.1);
  const Ran stood = explored({"run.duration_s=5", "run.rate_hz=15", "decision.strategy=none"});
  EXPECT_GT((ran.last.bodies[0].truth->position - stood.last.bodies[0].truth->position).norm(), 0.1)
      << "it drove";
  EXPECT_EQ(ran.last.bodies[0].estimate.position, again.last.bodies[0].estimate.position);
  EXPECT_EQ(ran.last.bodies.at(0).decision.scores, again.last.bodies.at(0).decision.scores);
}

TEST(RoomVehicle, AvoidsWalls) {
  const testing::Scratch scratch;
  const auto straight_on = [&](const std::string& obstacle_avoidance) {
    const std::string text =
        "[run]\nduration_s = 9\nrate_hz = 15\n[vehicle]\nmodel = \"terrain\"\n[start]\n"
        "from = \"free\"\n[mount]\nup_m = 1.2\nyaw_rad = 1.57\n[terrain]\n"
        "amplitude_m = 0.03\n[room]\nclearance_m = 0.3\n[controller]\ninput = [0.5, 0]\n";
    return run(load_scenario(scratch.write("mine.toml", text + obstacle_avoidance).string())).farthest_m;
  };
  EXPECT_GT(straight_on("avoidance_distance_m = 0.9"), 2) << "it never came near the wall";
  EXPECT_LT(straight_on("avoidance_distance_m = 0.9"), 3 - 0.3 - 0.03);
  EXPECT_GT(straight_on(""), 3 - 0.3 - 0.03) << "it reaches the wall without avoidance";
}

TEST(RoomVehicle, IsRefusedWithTheKey) {
  using testing::message_of;
  const auto complaint = [](const std::vector<std::string>& sets) {
    return message_of([&] { assemble(load_scenario("rendered-terrain", sets)); });
  };
  EXPECT_HAS(
      complaint({"terrain.amplitude_m=3"}),
      "--set: terrain.amplitude_m = 3.0: the terrain rises to 6 m, and must stay 0.5 m under the ceiling: "
      "make it lower");
  EXPECT_HAS(
      complaint({"room.boxes=24", "room.size_m=[6, 4, 2.5]", "start.from=free"}),
      "--set: room.boxes = 24: that many boxes do not fit along the walls of the room; take fewer; here "
      "room.size_m = [6.0, 4.0, 2.5] (--set)");
  EXPECT_HAS(complaint({"controller.gain_per_s=[100]"}), "--set: controller.gain_per_s = [100.0]: the gain");
  const testing::Scratch scratch;
  const std::string image = scratch.write("ground.pgm", "P2\n2 2\n255\n0 255\n51 0\n").string();
  EXPECT_HAS(complaint({"terrain.type=image", "terrain.file=" + image, "terrain.size_m=4"}),
             "--set: terrain.size_m = 4.0: the terrain must cover the floor of the room");
  EXPECT_HAS(complaint({"room.size_m=[8, 6, 2.5]"}), "start.target = targets/sheet.toml: has a corner at");
}

}  // namespace
}  // namespace incognita
