// Trials of loop closure: a camera looks out of a circle in a rendered room and turns around more than twice. The estimator is
// given a focal length with an error of some percent, so that its heading errs by as many percent of each turn, which its
// covariance does not know. Landmarks of the first turn then return beside where they are expected.
//
// One line per room, with and without loop closure: loops closed, frames lost, error of the trajectory after a similarity
// transform, and the slowest frame; then totals.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "bench/turning_camera.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {
namespace {

struct Wanted {
  int rooms = 10;
  std::uint64_t first_seed = 101;
  double focal_error = 0.02, turns = 2.3;
  bool frames = false;
  std::vector<std::string> sets;
};

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("incognita-loop-trials-{}", getpid());
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
};

struct Outcome {
  int closed = 0, lost = 0;
  double ate_m = 0, worst_ms = 0;
};

/// Error of the rotation since the first frame, rad; in the axes of the camera, since the worlds differ.
double rotation_error(const Trajectory& estimated, const Trajectory& truth) {
  const auto turned = [](const Trajectory& t) {
    return quaternion_product<double>(quaternion_conjugate(t.front().orientation), t.back().orientation);
  };
  return quaternion_log(quaternion_product<double>(quaternion_conjugate(turned(truth)), turned(estimated)))
      .norm();
}

/// Scale of the estimate over the last second; it begins with any, and should stay.
double scale(const Trajectory& estimated, const Trajectory& truth) {
  const std::size_t last = estimated.size() - 1, first = last - std::min<std::size_t>(last, 30);
  return (estimated[last].position - estimated[first].position).norm() /
         (truth[last].position - truth[first].position).norm();
}

void print_frame(const Estimate& estimate, const TrackedCamera& camera, double error_rad, double scale) {
  fmt::print("  {:.2f} s: {}, {} of {} matched, {} landmarks, rotation off by {:.3f} rad, scale {:.3f}{}\n",
             estimate.body().t, name(estimate.status.state), camera.matched, camera.predicted,
             camera.features.size(), error_rad, scale, estimate.last.loop_closed ? ", LOOP CLOSED" : "");
}

Outcome run(LoopParts& world, Estimator& estimator, bool frames) {
  Outcome out;
  Estimate estimate;
  Trajectory estimated, truth_of;
  while (const Tick tick = world.clock->next()) {
    const auto truth = world.world->move({}, tick);
    const Observation observation = world.sensor->measure(truth, tick);
    const std::clock_t before = std::clock();
    estimator.update(estimate, {}, observation, tick);
    out.worst_ms = std::max(out.worst_ms, 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    out.closed += estimate.last.loop_closed;
    if (!estimate.started) continue;
    out.lost += estimate.status.state == TrackingState::lost;
    const CameraState x = estimate.camera_state();
    estimated.push_back({tick.t, x.head<3>(), x.segment<4>(3)});
    const auto& pose = *truth->bodies[0].pose;
    truth_of.push_back({tick.t, pose.position, pose.world_from_body});
    if (frames && (tick.frame % 10 == 0 || estimate.last.loop_closed))
      print_frame(estimate, dynamic_cast<const SlamEstimator&>(estimator).cameras()[0].camera(),
                  rotation_error(estimated, truth_of), scale(estimated, truth_of));
  }
  const auto alignment = align({estimated, truth_of}, AlignmentKind::sim3);
  out.ate_m = alignment ? absolute_trajectory_error({aligned(estimated, *alignment), truth_of}).rmse : NAN;
  return out;
}

int trials(const Wanted& wanted) {
  const Folder folder;
  folder.write("turning.tum", turning_camera::trajectory(wanted.turns));
  const std::string world_file =
      folder.write("world.toml", turning_camera::scenario(wanted.turns, turning_camera::focal_px));
  const std::string estimator_file = folder.write(
      "estimator.toml",
      turning_camera::scenario(wanted.turns, turning_camera::focal_px * (1 + wanted.focal_error)));
  std::vector<double> errors_m[2];
  int lost[2] = {}, closed = 0;
  for (int room = 0; room < wanted.rooms; ++room) {
    std::string line = fmt::format("room {}:", wanted.first_seed + room);
    for (const bool closes : {true, false}) {
      std::vector<std::string> sets = wanted.sets;
      sets.push_back(fmt::format("run.seed={}", wanted.first_seed + room));
      sets.push_back(fmt::format("relocalization.close_loops={}", closes));
      Assembly world = assemble(load_scenario(world_file, sets));
      Assembly estimator = assemble(load_scenario(estimator_file, sets));
      const Outcome out = run(world.parts, *estimator.parts.estimator, wanted.frames);
      line += fmt::format(" {}: {} closed, {} frames lost, ATE {:.4f} m, slowest frame {:.0f} ms;",
                          closes ? "with" : " without", out.closed, out.lost, out.ate_m, out.worst_ms);
      errors_m[!closes].push_back(out.ate_m);
      lost[!closes] += out.lost;
      closed += out.closed;
    }
    std::cout << line << std::endl;
  }
  for (const bool closes : {true, false}) {
    const ErrorStatistics of = statistics(errors_m[!closes]);
    fmt::print("{} loop closure: ATE {:.4f} m in the median, at most {:.4f} m; {} frames lost\n",
               closes ? "with" : "without", of.median, of.max, lost[!closes]);
  }
  fmt::print("{} loops closed in {} rooms\n", closed, wanted.rooms);
  return 0;
}

}  // namespace
}  // namespace incognita

int main(int argc, char** argv) {
  incognita::Wanted wanted;
  CLI::App app(
      "Trials of loop closure: a camera turns around in rendered rooms, with an error of its focal length");
  app.footer("Example: loop_trials --rooms 10 --seed 201 --focal-error 0.01");
  app.add_option("--rooms", wanted.rooms, "Number of rooms")->check(CLI::PositiveNumber);
  app.add_option("--seed", wanted.first_seed, "Seed of the first room");
  app.add_option("--focal-error", wanted.focal_error,
                 "Of the estimator's focal length, relative; 0: no drift");
  app.add_option("--turns", wanted.turns, "Of the camera")->check(CLI::PositiveNumber);
  app.add_option("--set", wanted.sets, "KEY=VALUE of the scenario, for world and estimator");
  app.add_flag("--frames", wanted.frames, "Print every tenth frame");
  CLI11_PARSE(app, argc, argv);
  try {
    return incognita::trials(wanted);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
