// Trials of relocalization in the whole map: a free camera maps a rendered room in closed loop, and is then displaced by
// 0.5 to 3 m and turned by up to 180 degrees, by many random draws from the same state. Each trial runs in a child
// process, which continues the loop from there.
//
//   relocalization_trials --recording SCENARIO: the recording is cut after every 100 frames; half a second of black images
//   follows, and then frames from a random place of what was seen before. The reference is the estimate that the same run
//   had of these frames.
//   relocalization_trials [--maps N] [--trials N] [--map-s S] [--limit-s S] [--seed N] [--only TRIAL] [--other-room]
//                         [--scenario SCENARIO] [--set key=value]...
// `--only`: this trial of each map, frame by frame.
//
// One line per trial: whether the place is mapped (by the matches that a search from the true pose gives), when the
// camera was back, and the errors of its pose then, with their normalized square (6 degrees of freedom); then totals.
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {
namespace {

struct Wanted {
  int maps = 10, trials = 20;
  std::uint64_t first_seed = 1;
  double map_s = 60, limit_s = 2.5;
  int only = -1;
  bool other_room = false, recording = false;
  std::string scenario = "explore-room";
  std::vector<std::string> sets;
};

Wanted wanted_by(int argc, char** argv) {
  Wanted out;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return std::string(i + 1 < argc ? argv[++i] : "0"); };
    if (word == "--maps")
      out.maps = std::stoi(value());
    else if (word == "--trials")
      out.trials = std::stoi(value());
    else if (word == "--map-s")
      out.map_s = std::stod(value());
    else if (word == "--limit-s")
      out.limit_s = std::stod(value());
    else if (word == "--seed")
      out.first_seed = std::stoull(value());
    else if (word == "--scenario")
      out.scenario = value();
    else if (word == "--only")
      out.only = std::stoi(value());
    else if (word == "--recording")
      out.recording = true, out.scenario = value();
    else if (word == "--other-room")
      out.other_room = true;
    else if (word == "--set")
      out.sets.push_back(value());
    else {
      std::cerr << word << ": unknown option; see the head of bench/relocalization_trials.cpp\n";
      std::exit(2);
    }
  }
  return out;
}

/// The loop, one tick at a time.
struct Loop {
  Assembly assembly;
  Estimate estimate = {};
  Command command = {};
  std::optional<Truth> truth = {};
  std::shared_ptr<const Image> image = {};
  double t = 0;
  double estimator_ms = 0;  ///< processor time of the last update

  bool step(Sensor* other = nullptr) {
    LoopParts& parts = assembly.parts;
    const Tick tick = parts.clock->next();
    if (!tick) return false;
    t = tick.t;
    truth = parts.world->move(command, tick);
    const Observation observation = (other ? other : parts.sensor.get())->measure(truth, tick);
    if (!observation.bodies[0].images.empty()) image = observation.bodies[0].images[0];
    const std::clock_t before = std::clock();
    parts.estimator->update(estimate, command, observation, tick);
    estimator_ms = 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    const Goal goal = parts.strategy->choose(estimate, observation, tick);
    command = parts.controller->act(estimate, goal, observation, tick);
    return true;
  }
  const TrackedCamera& camera() const {
    return dynamic_cast<const SlamEstimator&>(*assembly.parts.estimator).cameras()[0].camera();
  }
  CameraState true_camera() const {
    CameraState x = CameraState::Zero();
    x.head<3>() = truth->bodies[0].pose->position;
    x.segment<4>(3) = truth->bodies[0].pose->world_from_body;
    return x;
  }
  bool is_lost() const { return estimate.status.state == TrackingState::lost; }
};

LoadedScenario scenario_of(const Wanted& wanted, std::uint64_t seed) {
  std::vector<std::string> sets = {"run.duration_s=" + std::to_string(wanted.map_s + wanted.limit_s + 5),
                                   "run.seed=" + std::to_string(seed)};
  sets.insert(sets.end(), wanted.sets.begin(), wanted.sets.end());
  return load_scenario(wanted.scenario, sets);
}

struct Outcome {
  int predicted = 0, mapped = 0;  ///< features in view, and found, from the true pose
  double moved_m = 0, turned_rad = 0;
  double lost_after_s = -1, back_after_s = -1;
  double error_m = 0, error_rad = 0, nees = 0;                 ///< when it is back
  double late_error_m = 0, late_error_rad = 0, late_nees = 0;  ///< five frames later
  bool lost_again = false, never_lost = false;
  double worst_ms = 0, mean_ms = 0;  ///< of the estimator, lost
};

struct PoseError {
  double m, rad, nees;
};

PoseError error_of(const Loop& loop) {
  Eigen::Matrix<double, 12, 1> e;
  const CameraState truth = loop.true_camera(), x = loop.estimate.camera_state();
  FreeCameraMotion::chart.minus({truth.data(), 13}, {x.data(), 13}, {e.data(), 12});
  const Eigen::Matrix<double, 6, 1> pose = e.head<6>();
  const Eigen::Matrix<double, 6, 6> P = loop.estimate.body().pose_covariance;
  return {pose.head<3>().norm(), pose.tail<3>().norm(), pose.dot(P.llt().solve(pose))};
}

void print_frame(const Loop& loop, double start_t) {
  const PoseError e = error_of(loop);
  const TrackedCamera& camera = loop.camera();
  std::printf("     %.2f s: %s, %d of %d matched, off by %.2f m %.2f rad, nees %.0f, sigma %.2f px, %s\n",
              loop.t - start_t, name(loop.estimate.status.state), camera.matched, camera.predicted, e.m,
              e.rad, e.nees, std::sqrt(camera.pixel_var()), loop.estimate.status.reason.c_str());
}

Outcome run_trial(Loop& loop, const Wanted& wanted, std::uint64_t seed, int trial) {
  RandomStream random(seed * 1000 + static_cast<std::uint64_t>(trial), "bench.displacement");
  Outcome out;
  const CameraState before = loop.true_camera();
  std::optional<Assembly> other;
  if (wanted.other_room) other = assemble(scenario_of(wanted, seed + 1000));
  constexpr int tries = 1000;
  for (int i = 0; i < tries; ++i) {
    const double far = random.uniform(0.5, 3),
                 direction = random.uniform(-std::numbers::pi, std::numbers::pi);
    const Eigen::Vector3d by(far * std::cos(direction), far * std::sin(direction), random.uniform(-0.3, 0.3));
    const Eigen::Vector3d to = Eigen::Vector3d(before.head<3>()) + by;
    if (std::abs(to.x()) > 2.5 || std::abs(to.y()) > 2.5 || to.z() < 0.4 || to.z() > 2.1) continue;
    out.turned_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
    loop.assembly.parts.world->displace({0, by, out.turned_rad});
    break;
  }
  const double start_t = loop.t;
  int frames = 0, lost_frames = 0, after = -1;
  while (loop.t - start_t < wanted.limit_s + (after >= 0 ? 1 : 0)) {
    if (!loop.step(other ? other->parts.sensor.get() : nullptr)) break;
    if (wanted.only >= 0) print_frame(loop, start_t);
    if (frames++ == 0) {
      out.moved_m = (loop.true_camera().head<3>() - before.head<3>()).norm();
      SummedImage summed;
      summed.assign(*loop.image);
      const PoseEvidence evidence = gather_evidence(summed, loop.estimate, loop.camera(), loop.true_camera(),
                                                    4e-4 * PoseCov::Identity());
      out.predicted = static_cast<int>(evidence.matches.size());
      out.mapped = evidence.matched;
    }
    if (loop.is_lost()) {
      if (out.lost_after_s < 0)
        out.lost_after_s = loop.t - start_t;
      else {
        out.worst_ms = std::max(out.worst_ms, loop.estimator_ms);
        out.mean_ms += loop.estimator_ms;
        ++lost_frames;
      }
      out.lost_again |= after >= 0;
    } else if (out.lost_after_s >= 0 && after < 0) {
      after = 0;
      out.back_after_s = loop.t - start_t;
      const PoseError e = error_of(loop);
      out.error_m = e.m, out.error_rad = e.rad, out.nees = e.nees;
    }
    if (after >= 0 && after++ == 5) {
      const PoseError e = error_of(loop);
      out.late_error_m = e.m, out.late_error_rad = e.rad, out.late_nees = e.nees;
    }
  }
  out.never_lost = out.lost_after_s < 0;
  if (out.never_lost) {
    const PoseError e = error_of(loop);
    out.error_m = e.m, out.error_rad = e.rad, out.nees = e.nees;
  }
  if (lost_frames > 0) out.mean_ms /= lost_frames;
  return out;
}

/// In a child process: the loop here stays as it is.
Outcome trial_in_child(Loop& loop, const Wanted& wanted, std::uint64_t seed, int trial) {
  Outcome out;
  int ends[2];
  if (pipe(ends) != 0) std::exit(1);
  const pid_t child = fork();
  if (child == 0) {
    const Outcome result = run_trial(loop, wanted, seed, trial);
    std::fflush(stdout);
    const bool written = write(ends[1], &result, sizeof result) == sizeof result;
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  if (read(ends[0], &out, sizeof out) != sizeof out) std::cerr << "trial failed\n";
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return out;
}

/// Frames of a recording, and again those of before.
class CutSensor final : public Sensor {
 public:
  explicit CutSensor(Sensor& sensor) : sensor_(sensor) {}
  std::vector<Observation> seen;
  std::size_t black = 0, again_from = 0;
  bool cut = false;

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override {
    if (!cut) return seen.emplace_back(sensor_.measure(truth, tick));
    Observation out = seen.back();
    for (auto& image : out.bodies[0].images) {
      if (black > 0)
        image = std::make_shared<const Image>(image->width(), image->height(), std::uint8_t{8});
      else
        image = seen.at(again_from).bodies[0].images.at(0);
    }
    black > 0 ? --black : ++again_from;
    return out;
  }

 private:
  Sensor& sensor_;
};

Outcome run_cut(Loop& loop, CutSensor& sensor, const std::vector<CameraState>& poses, std::size_t from) {
  constexpr int black = 15, frames = 60;
  Outcome out;
  sensor.cut = true, sensor.black = black, sensor.again_from = from;
  for (int i = 0; i < black; ++i) loop.step(&sensor);
  out.never_lost = !loop.is_lost();
  const CameraState lost_at = loop.estimate.camera_state();
  const CameraState& there = poses.at(from);
  out.moved_m = (lost_at.head<3>() - there.head<3>()).norm();
  out.turned_rad = 2 * std::acos(std::min(1.0, std::abs(lost_at.segment<4>(3).dot(there.segment<4>(3)))));
  SummedImage summed;
  summed.assign(*sensor.seen.at(from).bodies[0].images.at(0));
  const PoseEvidence evidence =
      gather_evidence(summed, loop.estimate, loop.camera(), there, 4e-4 * PoseCov::Identity());
  out.predicted = static_cast<int>(evidence.matches.size()), out.mapped = evidence.matched;
  out.lost_after_s = 0;
  for (int i = 0; i < frames && loop.step(&sensor); ++i) {
    out.worst_ms = std::max(out.worst_ms, loop.estimator_ms);
    if (loop.is_lost()) {
      out.lost_again |= out.back_after_s >= 0;
      continue;
    }
    const CameraState x = loop.estimate.camera_state();
    const CameraState& reference = poses.at(from + static_cast<std::size_t>(i));
    const double m = (x.head<3>() - reference.head<3>()).norm(),
                 rad = 2 * std::acos(std::min(1.0, std::abs(x.segment<4>(3).dot(reference.segment<4>(3)))));
    if (out.back_after_s < 0) out.back_after_s = (i + 1) / 30.0, out.error_m = m, out.error_rad = rad;
    out.late_error_m = m, out.late_error_rad = rad;
  }
  return out;
}

int run_recording(const Wanted& wanted) {
  std::vector<std::string> sets = wanted.sets;
  Loop loop{assemble(load_scenario(wanted.scenario, sets))};
  CutSensor sensor(*loop.assembly.parts.sensor);
  std::vector<CameraState> poses;
  RandomStream random(wanted.first_seed, "bench.cuts");
  int all = 0, back = 0, mapped = 0, mapped_back = 0, wrong = 0;
  while (loop.step(&sensor)) {
    poses.push_back(loop.estimate.started ? loop.estimate.camera_state() : CameraState(CameraState::Zero()));
    const std::size_t frames = poses.size();
    if (frames % 100 != 0 || frames < 200 || loop.is_lost()) continue;
    constexpr std::size_t needed = 80;  // ticks of a trial
    if (frames + needed > static_cast<std::size_t>(loop.assembly.parts.clock->expected_frames())) break;
    for (int k = 0; k < wanted.trials; ++k) {
      const auto from = static_cast<std::size_t>(random.below(static_cast<int>(frames) - 80));
      Outcome o;
      int ends[2];
      if (pipe(ends) != 0) return 1;
      const pid_t child = fork();
      if (child == 0) {
        const Outcome result = run_cut(loop, sensor, poses, from);
        _exit(write(ends[1], &result, sizeof result) == sizeof result ? 0 : 1);
      }
      close(ends[1]);
      if (read(ends[0], &o, sizeof o) != sizeof o) std::cerr << "trial failed\n";
      close(ends[0]);
      waitpid(child, nullptr, 0);
      const bool is_back = o.back_after_s >= 0, is_mapped = o.mapped >= 6;
      const bool is_wrong = is_back && (o.error_m > 0.1 || o.error_rad > 0.1);
      ++all, back += is_back, mapped += is_mapped, mapped_back += is_mapped && is_back, wrong += is_wrong;
      std::printf(
          "cut at %zu, again from %zu: %.2f m and %.0f deg away, %d of %d found, back %.2f s, off by %.3f m %.3f rad, "
          "at the end %.3f m %.3f rad, at most %.0f ms%s%s%s\n",
          frames, from, o.moved_m, o.turned_rad * 180 / std::numbers::pi, o.mapped, o.predicted,
          o.back_after_s, o.error_m, o.error_rad, o.late_error_m, o.late_error_rad, o.worst_ms,
          is_wrong ? " WRONG" : "", is_mapped && !is_back ? " MISSED" : "",
          o.lost_again ? " LOST AGAIN" : "");
      std::fflush(stdout);
    }
  }
  std::printf("%d cuts, %d into mapped places: %d back within 2 s; back in all %d, wrong %d\n", all, mapped,
              mapped_back, back, wrong);
  return wrong == 0 ? 0 : 1;
}

int run(const Wanted& wanted) {
  int mapped = 0, back = 0, wrong = 0, still_wrong = 0, all_back = 0, all = 0, again = 0;
  std::vector<double> nees, late_nees, seconds;
  for (int m = 0; m < wanted.maps; ++m) {
    const std::uint64_t seed = wanted.first_seed + static_cast<std::uint64_t>(m);
    Loop loop{assemble(scenario_of(wanted, seed))};
    while (loop.t < wanted.map_s && loop.step()) {
    }
    const PoseError at_start = error_of(loop);
    std::printf("map %llu: %d landmarks, state %s, error %.3f m %.3f rad\n",
                static_cast<unsigned long long>(seed), loop.estimate.mapped_count(),
                name(loop.estimate.status.state), at_start.m, at_start.rad);
    for (int k = 0; k < wanted.trials; ++k) {
      if (wanted.only >= 0 && k != wanted.only) continue;
      std::fflush(stdout);
      const Outcome o = trial_in_child(loop, wanted, seed, k);
      const bool is_mapped = !wanted.other_room && o.mapped >= 6;
      const bool is_back = o.back_after_s >= 0;
      const auto is_far = [&](double off_m, double off_rad) {
        return wanted.other_room || off_m > 0.3 || off_rad > 0.15;
      };
      const bool is_wrong = (is_back || o.never_lost) && is_far(o.error_m, o.error_rad);
      still_wrong +=
          is_wrong && (o.never_lost || (!o.lost_again && is_far(o.late_error_m, o.late_error_rad)));
      ++all, mapped += is_mapped, all_back += is_back, wrong += is_wrong, again += o.lost_again;
      const bool is_tracked = o.never_lost && !is_wrong;  // through the displacement
      back += is_mapped && (is_tracked || (is_back && o.back_after_s <= 2));
      if (is_back && !is_wrong)
        nees.push_back(o.nees), late_nees.push_back(o.late_nees), seconds.push_back(o.back_after_s);
      std::printf(
          "  %2d moved %.2f m turned %4.0f deg, %2d of %2d found from the truth, lost %.2f s, back %.2f s, error %.3f m "
          "%.3f rad nees %.1f, later %.3f m %.3f rad nees %.1f, %.0f ms, at most %.0f ms%s%s%s\n",
          k, o.moved_m, o.turned_rad * 180 / std::numbers::pi, o.mapped, o.predicted, o.lost_after_s,
          o.back_after_s, o.error_m, o.error_rad, o.nees, o.late_error_m, o.late_error_rad, o.late_nees,
          o.mean_ms, o.worst_ms, is_wrong ? " WRONG" : "",
          is_mapped && !is_back && !is_tracked ? " MISSED" : "", o.lost_again ? " LOST AGAIN" : "");
      std::fflush(stdout);
    }
  }
  const auto median = [](std::vector<double> v) {
    if (v.empty()) return 0.0;
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  };
  const auto mean = [](const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x;
    return v.empty() ? 0 : sum / static_cast<double>(v.size());
  };
  std::printf(
      "%d trials, %d in mapped places: %d back within 2 s; back in all %d, wrong %d (five frames "
      "later %d), lost again %d; median %.2f s; "
      "nees/6 mean %.2f median %.2f, later %.2f %.2f\n",
      all, mapped, back, all_back, wrong, still_wrong, again, median(seconds), mean(nees) / 6,
      median(nees) / 6, mean(late_nees) / 6, median(late_nees) / 6);
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace incognita

int main(int argc, char** argv) {
  const incognita::Wanted wanted = incognita::wanted_by(argc, argv);
  return wanted.recording ? incognita::run_recording(wanted) : incognita::run(wanted);
}
