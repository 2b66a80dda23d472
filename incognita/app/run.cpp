#include "incognita/app/run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "incognita/app/assemble.hpp"
#include "incognita/app/progress.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/frame_pictures.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/report/run_figures.hpp"

namespace incognita {
namespace {

struct Options {
  std::string scenario = "room";
  std::string out;
  std::vector<std::string> sets;
  std::optional<std::int64_t> seed;
  std::optional<double> duration_s;
  bool realtime = false;
  bool save_frames = false;
  bool no_figures = false;
};

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

LoadedScenario load(const Options& options) {
  std::vector<Flag> flags;
  if (options.seed) flags.push_back({"run.seed", std::to_string(*options.seed), "--seed"});
  if (options.duration_s)
    flags.push_back({"run.duration_s", fmt::format("{}", *options.duration_s), "--duration"});
  return load_scenario(options.scenario, options.sets, flags);
}

/// How the run ended, from the loop's own view.
struct Ending {
  RunStatus status = RunStatus::done;
  std::string reason;
};

Ending ending_of(const Snapshot& last, const Tick& tick) {
  if (interrupted) return {RunStatus::interrupted, fmt::format("interrupted at t = {:.3f} s", tick.t)};
  if (last.status.state == TrackingState::starting)
    return {RunStatus::failed, "never started: " + last.status.reason};
  if (last.status.state == TrackingState::lost)
    return {RunStatus::failed, fmt::format("lost at the end: {}", last.status.reason)};
  return {};
}

/// Says on standard error when the tracking state changes, once.
class StateTeller {
 public:
  void tell(const Snapshot& s) {
    const bool is_lost = s.status.state == TrackingState::lost;
    if (is_lost && !was_lost_) fmt::print(stderr, "t = {:.3f} s: lost: {}\n", s.tick.t, s.status.reason);
    if (!is_lost && was_lost_)
      fmt::print(stderr, "t = {:.3f} s: {}: {}\n", s.tick.t, name(s.status.state), s.status.reason);
    was_lost_ = is_lost;
  }

 private:
  bool was_lost_ = false;
};

void wait_until(std::chrono::steady_clock::time_point start, double t_s) {
  std::this_thread::sleep_until(start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                            std::chrono::duration<double>(t_s)));
}

Ending drive(Assembly& assembly, Recorder& recorder, FramePictures* pictures, bool realtime) {
  Progress progress(assembly.boxes.clock->expected_frames());
  StateTeller teller;
  Snapshot last;
  std::optional<double> first_t;
  const auto start = std::chrono::steady_clock::now();
  const auto publish = [&](const Snapshot& snapshot) {
    last = snapshot;
    recorder.publish(snapshot);
    if (pictures) pictures->publish(snapshot);
    progress.show(snapshot.tick.frame + 1,
                  fmt::format("{}, {} matched, {} landmarks", name(snapshot.status.state), snapshot.matched,
                              snapshot.landmarks.size()));
    teller.tell(snapshot);
  };
  const auto keep_going = [&](const Tick& tick) {
    if (!first_t) first_t = tick.t;
    if (realtime) wait_until(start, tick.t - *first_t);
    return !interrupted;
  };
  try {
    run_loop(assembly.boxes, publish, keep_going);
  } catch (const std::exception& error) {
    return {RunStatus::failed, fmt::format("at frame {}: {}", last.tick.frame + 1, error.what())};
  }
  return ending_of(last, last.tick);
}

int run(const Options& options) {
  const LoadedScenario loaded = load(options);
  for (const std::string& line : loaded.overrides) fmt::print(stderr, "{}\n", line);
  Assembly assembly = assemble(loaded);
  for (const std::string& line : assembly.notes) fmt::print(stderr, "{}\n", line);
  if (!assembly.scale_is_known)
    fmt::print(stderr, "no target: the scale is not observable, lengths are relative\n");

  const std::string out = options.out.empty() ? "out/" + loaded.name : options.out;
  RunInfo info;
  info.effective_toml = effective_toml(loaded);
  info.seed = loaded.scenario.run.seed;
  info.version = INCOGNITA_VERSION;
  info.patch_size_px = loaded.scenario.slam.search.patch_size_px;
  // A recording's truth is in its own world, which a target need not share
  const bool own_frame = loaded.scenario.run.world == "recording";
  info.ate_alignment = !assembly.scale_is_known ? "sim3" : own_frame ? "se3" : "none";
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a full disk is an error that is reported, not a death
  Recorder recorder(out, info);
  std::optional<FramePictures> pictures;
  if (options.save_frames) pictures.emplace(recorder.path(), loaded.scenario.slam.search.patch_size_px);

  const Ending ending = drive(assembly, recorder, pictures ? &*pictures : nullptr, options.realtime);
  const auto finishing = [&](const std::filesystem::path& directory) {
    return options.no_figures ? std::vector<std::string>{} : draw_run_figures(directory);
  };
  const RunOutcome outcome = recorder.finish(ending.status, ending.reason, finishing);
  fmt::print(stderr, "{}{}{}: see {}\n", name(outcome.status), outcome.reason.empty() ? "" : ", ",
             outcome.reason, out);
  return outcome.status == RunStatus::done ? 0 : 1;
}

}  // namespace

CLI::App* add_run(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand("run", "Run the loop from a scenario file");
  auto options = std::make_shared<Options>();
  command->add_option("scenario", options->scenario, "Scenario file, or the name of a built-in one")
      ->capture_default_str();
  command->add_option("--out", options->out, "Run directory [out/<scenario>]");
  command->add_option("--seed", options->seed, "Seed of all randomness");
  command->add_option("--set", options->sets, "Override a setting, e.g. --set map.wanted_visible=20")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--duration", options->duration_s, "Stop after so many seconds");
  command->add_flag("--realtime", options->realtime, "No faster than the clock on the wall");
  command->add_flag("--save-frames", options->save_frames,
                    "Write a picture of every frame, ellipses drawn in");
  command->add_flag("--no-figures", options->no_figures, "Leave out the figures");
  command->footer("Example:\n  incognita run room --seed 7 --duration 20 --out out/first\n");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
  return command;
}

}  // namespace incognita
