// A camera turns around in a rendered room, with an error of one percent of the focal length: its heading then errs by as much of
// the turn, which its covariance does not know. Ten rooms and other errors: bench/loop_trials.cpp.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "bench/turning_camera.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {
namespace {

constexpr double turns = 1.25;

struct Outcome {
  int closed = 0, lost = 0;
  double ate_m = 0;
};

std::string written(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

Outcome turn_around(double focal_error, const std::string& close_loops) {
  written("turning.tum", turning_camera::trajectory(turns));
  const std::vector<std::string> sets{"run.seed=101", "relocalization.close_loops=" + close_loops};
  const auto with_focal = [&](const std::string& name, double focal_px) {
    return assemble(load_scenario(written(name, turning_camera::scenario(turns, focal_px)), sets));
  };
  Assembly world = with_focal("world.toml", turning_camera::focal_px);
  Assembly estimator = with_focal("estimator.toml", turning_camera::focal_px * (1 + focal_error));
  Outcome out;
  Estimate estimate;
  Trajectory estimated, true_poses;
  while (const Tick tick = world.parts.clock->next()) {
    const auto truth = world.parts.world->move({}, tick);
    estimator.parts.estimator->update(estimate, {}, world.parts.sensor->measure(truth, tick), tick);
    if (!estimate.started) continue;
    out.closed += estimate.last.loop_closed;
    out.lost += estimate.status.state == TrackingState::lost;
    const CameraState x = estimate.camera_state();
    estimated.push_back({tick.t, x.head<3>(), x.segment<4>(3)});
    true_poses.push_back({tick.t, truth->bodies[0].pose->position, truth->bodies[0].pose->world_from_body});
  }
  const auto alignment = align({estimated, true_poses}, AlignmentKind::sim3);
  out.ate_m = absolute_trajectory_error({aligned(estimated, *alignment), true_poses}).rmse;
  return out;
}

TEST(LoopClosureInRoom, CorrectsTheDrift) {
  const Outcome with = turn_around(0.01, "true"), without = turn_around(0.01, "false");
  EXPECT_GE(with.closed, 1);
  EXPECT_EQ(without.closed, 0);
  EXPECT_EQ(with.lost, 0);
  EXPECT_LT(with.ate_m, 0.7 * without.ate_m);
}

TEST(LoopClosureInRoom, IsNotSeenWithoutDrift) {
  const Outcome with = turn_around(0, "true");
  EXPECT_EQ(with.closed, 0);
  EXPECT_EQ(with.lost, 0);
  EXPECT_LT(with.ate_m, 0.02);
}

}  // namespace
}  // namespace incognita
