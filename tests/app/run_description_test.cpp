// What a run records for its display besides the estimate: its surroundings, depth hypotheses, the exploration volume.
#include <gtest/gtest.h>

#include <bit>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/loop.hpp"
#include "incognita/app/loop/world_outline.hpp"
#include "incognita/models/motion/terrain.hpp"

namespace incognita {
namespace {

RunInfo info_of(const std::string& scenario, const std::vector<std::string>& sets = {}) {
  return assemble(load_scenario(scenario, sets)).info;
}

TEST(RunDescription, HasTheRoomAndTheCamera) {
  const RunInfo info = info_of("explore-room", {"room.size_m=[6,7,2.5]", "room.boxes=4"});
  EXPECT_EQ(info.name, "explore-room");
  EXPECT_EQ(info.rate_hz, 15);
  ASSERT_TRUE(info.camera);
  EXPECT_EQ(info.camera->width, 320);
  EXPECT_EQ(info.camera->fx, 195);
  EXPECT_EQ(info.camera->cy, 119.5);
  ASSERT_TRUE(info.room);
  EXPECT_EQ(info.room->inside.min, Eigen::Vector3d(-3, -3.5, 0));
  EXPECT_EQ(info.room->inside.max, Eigen::Vector3d(3, 3.5, 2.5));
  ASSERT_EQ(info.room->boxes.size(), 4u);
  for (const BoxOutline& box : info.room->boxes) EXPECT_TRUE((box.max.array() > box.min.array()).all());
  EXPECT_FALSE(info.terrain) << "the floor is level";
}

TEST(RunDescription, HasUnevenGround) {
  const RunInfo in_room = info_of("explore-terrain"), outside = info_of("terrain");
  ASSERT_TRUE(in_room.room && in_room.terrain);
  EXPECT_LT(in_room.room->inside.min.z(), 0) << "the walls extend below the ground";
  ASSERT_TRUE(outside.terrain);
  EXPECT_FALSE(outside.room);
  EXPECT_EQ(outside.terrain->columns, 64);
  EXPECT_EQ(outside.terrain->rows, 64);
  EXPECT_EQ(outside.terrain->origin_m, Eigen::Vector2d(-20, -20));
  EXPECT_FALSE(info_of("two-robots").terrain);
  EXPECT_FALSE(info_of("two-robots").camera);
  EXPECT_TRUE(info_of("free-camera").camera) << "it measures points in the image";
}

TEST(RunDescription, TerrainGridHasTheHeightsAtItsPoints) {
  const Terrain ground(TiltedPlane{0.3, 0.1, -0.2});
  const auto grid = terrain_grid(ground, {-1, -2}, {5.3, 1.15});
  ASSERT_TRUE(grid);
  EXPECT_NEAR(grid->step_m, 0.1, 1e-12);
  ASSERT_EQ(grid->columns, 64);
  ASSERT_EQ(grid->rows, 33);
  ASSERT_EQ(grid->heights_m.size(), 64u * 33u);
  const double height = ground.at<double>(-1 + 0.1 * 10, -2 + 0.1 * 7).height;
  EXPECT_NEAR(grid->heights_m[64 * 7 + 10], height, 1e-12);
  EXPECT_FALSE(terrain_grid({}, {-1, -1}, {1, 1}));
}

TEST(RunDescription, RecordingsHaveTheirMeanRate) {
  EXPECT_EQ(mean_rate_hz({10, 10.1, 10.3, 10.5}), 6);
  EXPECT_FALSE(mean_rate_hz({10}));
}

TEST(RunDescription, SnapshotsHaveDepthHypothesesAndTheExplorationVolume) {
  Assembly assembly = assemble(load_scenario(
      "explore-room",
      std::vector<std::string>{"run.duration_s=3", "landmark_initialization.method=depth-line"}));
  int rays = 0, of_several = 0, volumes = 0;
  std::shared_ptr<const ExplorationVolume> volume;
  const auto publish = [&](const Snapshot& s) {
    for (const SnapshotMatch& match : s.matches) {
      EXPECT_EQ(match.particles.empty(), !match.ray);
      if (!match.ray) continue;
      ++rays;
      of_several += match.particles.size() > 1;
      double share = 0;
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (const SnapshotParticle& particle : match.particles) {
        share += particle.weight;
        mean += particle.weight * particle.pixel;
      }
      EXPECT_LT(share, 1 + 1e-9);
      EXPECT_LT((mean / share - match.predicted).norm(), 1e-6);
    }
    ASSERT_EQ(s.exploration != nullptr, s.coverage.has_value());
    if (!s.exploration) return;
    volumes += s.exploration != volume;
    volume = s.exploration;
    int seen = 0;
    for (const std::uint8_t byte : volume->seen) seen += std::popcount(byte);
    EXPECT_NEAR(*s.coverage, static_cast<double>(seen) / volume->cells.prod(), 1e-12);
  };
  run_loop(assembly.parts, publish, [](const Tick&) { return true; });
  EXPECT_GT(rays, 20);
  EXPECT_GT(of_several, 20);
  EXPECT_GT(volumes, 1);
  EXPECT_LT(volumes, 45) << "replaced only when a cell becomes seen";
}

}  // namespace
}  // namespace incognita
