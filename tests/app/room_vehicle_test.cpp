// A vehicle with a camera on uneven ground in the rendered room, from its scenario to a run.
#include <gtest/gtest.h>

#include "incognita/analysis/pose_consistency.hpp"
#include "incognita/app/assemble_room_vehicle.hpp"
#include "incognita/io/settings.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

struct Ran {
  int frames = 0, lost = 0;
  double rms_m = 0, sigma_speed = 0, height_span_m = 0, farthest_m = 0;
  Snapshot last;
};

Ran run(const std::vector<std::string>& sets) {
  RoomVehicleAssembly assembly = assemble_room_vehicle(load_scenario("rendered-terrain", sets));
  Ran ran;
  double low = 1e9, high = -1e9;
  run_loop(assembly.boxes, std::function<void(const Snapshot&)>([&](const Snapshot& s) {
             ran.last = s;
             ++ran.frames;
             ran.lost += s.status.state == TrackingState::lost || s.status.state == TrackingState::starting;
             ran.rms_m += (s.camera.head<3>() - s.truth->camera.head<3>()).squaredNorm();
             ran.sigma_speed += std::sqrt(s.covariance.diagonal().segment<3>(6).sum());
             const SmallVector& axle = s.truth->vehicles.front();
             ran.farthest_m = std::max(ran.farthest_m, axle.head<2>().cwiseAbs().maxCoeff());
             low = std::min(low, s.truth->camera[2]);
             high = std::max(high, s.truth->camera[2]);
           }),
           std::function<bool(const Tick&)>([](const Tick&) { return true; }));
  ran.rms_m = std::sqrt(ran.rms_m / ran.frames);
  ran.sigma_speed /= ran.frames;
  ran.height_span_m = high - low;
  return ran;
}

TEST(RoomVehicle, KnowsWhereItIsByImagesAloneOnUnevenGround) {
  const Ran ran = run({"run.duration_s=8"});
  EXPECT_EQ(ran.frames, 240);
  EXPECT_EQ(ran.lost, 0);
  EXPECT_LT(ran.rms_m, 0.05);
  EXPECT_GT(ran.height_span_m, 0.03) << "the ground is level";
  EXPECT_GT(ran.last.landmarks.size(), 10u);
}

TEST(RoomVehicle, WheelsHelp) {
  const Ran images = run({"run.duration_s=4"}), wheels = run({"run.duration_s=4", "filter.odometry=true"});
  EXPECT_EQ(wheels.lost, 0);
  EXPECT_LT(wheels.rms_m, 0.05);
  EXPECT_LT(wheels.sigma_speed, 0.7 * images.sigma_speed);
}

TEST(RoomVehicle, SameSeedSameRun) {
  const Ran one = run({"run.duration_s=2"}), two = run({"run.duration_s=2"});
  EXPECT_EQ(one.last.camera, two.last.camera);
  EXPECT_EQ(one.last.covariance, two.last.covariance);
}

TEST(RoomVehicle, KeepsClearOfWalls) {
  const Ran ran = run({"run.duration_s=12", "steer.input=[0.4, 0]", "start.from=free"});
  EXPECT_GT(ran.farthest_m, 2) << "it never came near";
  EXPECT_LT(ran.farthest_m, 3 - 0.15 - 0.03);
}

TEST(RoomVehicle, IsRefusedWithTheKey) {
  using testing::message_of;
  const auto complaint = [](const std::vector<std::string>& sets) {
    return message_of([&] { assemble_room_vehicle(load_scenario("rendered-terrain", sets)); });
  };
  EXPECT_HAS(complaint({"terrain.amplitude_m=3"}), "the terrain rises to");
  EXPECT_HAS(complaint({"room.size_m=[8, 6, 2.5]"}), "start.target = targets/sheet.toml: has a corner at");
}

}  // namespace
}  // namespace incognita
