#include "incognita/app/run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "incognita/app/assemble.hpp"
#include "incognita/app/assemble_planar.hpp"
#include "incognita/app/assemble_team.hpp"
#include "incognita/app/observability_watch.hpp"
#include "incognita/app/progress.hpp"
#include "incognita/app/say.hpp"
#include "incognita/app/team_models.hpp"
#include "incognita/io/team_setting_list.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/frame_pictures.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/report/run_figures.hpp"

namespace incognita {
namespace {

struct Options {
  std::string scenario = "room";
  std::optional<std::string> out;
  std::vector<std::string> sets;
  std::optional<std::string> seed, duration_s;  // texts: the setting knows what it may be
  bool realtime = false;
  bool save_frames = false;
  bool no_figures = false;
};

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// Asked to end, however often, the run closes its files first; that takes a frame and the figures.
void heed_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, interrupt) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);  // nohup
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a full disk is an error that is reported, not a death
}

LoadedScenario load(const Options& options) {
  std::vector<Flag> flags;
  if (options.seed) flags.push_back({"run.seed", *options.seed, "--seed"});
  if (options.duration_s) flags.push_back({"run.duration_s", *options.duration_s, "--duration"});
  return load_scenario(options.scenario, options.sets, flags);
}

/// How the run ended, from the loop's own view.
struct Ending {
  RunStatus status = RunStatus::done;
  std::string reason;
  std::vector<std::string> warnings = {};
  bool saw_nothing = false;
};

Ending ending_of(const Snapshot& last, const Tick& tick, bool ever_tracked) {
  if (interrupted) return {RunStatus::interrupted, fmt::format("interrupted at t = {:.3f} s", tick.t)};
  if (!ever_tracked) return {RunStatus::failed, "never started: " + last.status.reason};
  if (last.status.state == TrackingState::lost)
    return {RunStatus::failed, fmt::format("lost at the end: {}", last.status.reason)};
  return {};
}

/// Says on standard error when the tracking state changes, once.
class StateTeller {
 public:
  void tell(const Snapshot& s) {
    const bool is_lost = s.status.state == TrackingState::lost;
    if (is_lost && !was_lost_) say("t = {:.3f} s: lost: {}\n", s.tick.t, s.status.reason);
    if (!is_lost && was_lost_) say("t = {:.3f} s: {}: {}\n", s.tick.t, name(s.status.state), s.status.reason);
    was_lost_ = is_lost;
  }

 private:
  bool was_lost_ = false;
};

/// In naps: whoever interrupts a run of one frame an hour does not wait an hour.
void wait_until(std::chrono::steady_clock::time_point start, double t_s) {
  constexpr double nap_s = 0.05;
  for (;;) {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    const double left_s = t_s - waited.count();
    if (interrupted || left_s <= 0) return;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, nap_s)));
  }
}

template <class SomeBoxes>
Ending drive(SomeBoxes& boxes, Recorder& recorder, FramePictures* pictures, ObservabilityWatch* watch,
             bool realtime) {
  Progress progress(boxes.clock->expected_frames());
  StateTeller teller;
  Snapshot last;
  bool ever_tracked = false, ever_looked = false;
  std::optional<double> first_t;
  const auto start = std::chrono::steady_clock::now();
  const auto publish = [&](const Snapshot& snapshot) {
    last = snapshot;
    ever_tracked |=
        snapshot.status.state != TrackingState::starting && snapshot.status.state != TrackingState::lost;
    ever_looked |= !snapshot.looks.empty();
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
  std::function<void(const typename SomeBoxes::Estimator::Estimate&)> watching;
  if constexpr (requires(const typename SomeBoxes::Estimator::Estimate& estimate) {
                  watch->follow(estimate);
                })
    if (watch) watching = [watch](const auto& estimate) { watch->follow(estimate); };
  try {
    run_loop(boxes, std::function<void(const Snapshot&)>(publish),
             std::function<bool(const Tick&)>(keep_going), watching);
  } catch (const std::exception& error) {
    return {RunStatus::failed, fmt::format("at frame {}: {}", last.tick.frame + 1, error.what())};
  }
  Ending ending = ending_of(last, last.tick, ever_tracked);
  const auto unseen = std::count_if(last.landmarks.begin(), last.landmarks.end(),
                                    [](const SnapshotLandmark& l) { return l.anchor && l.sightings == 0; });
  if (unseen > 0 && last.vehicles.empty())
    ending.warnings.push_back(
        fmt::format("anchors never matched: {}; are they where they should be?", unseen));
  if (!last.vehicles.empty() && !ever_looked) ending.warnings.push_back("nothing was seen in the whole run");
  return ending;
}

RunInfo info_of(const LoadedScenario& loaded) {
  RunInfo info;
  info.effective_toml = effective_toml(loaded);
  info.seed = loaded.scenario.run.seed;
  info.version = INCOGNITA_VERSION;
  info.patch_size_px = loaded.scenario.slam.search.patch_size_px;
  return info;
}

/// What the run knows of its frame and scale, into summary.json and on standard error.
void tell_observability(ObservabilityWatch& watch, Recorder& recorder) {
  const auto report = watch.report();
  if (!report) return;
  recorder.note(*report);
  for (const std::string& line : in_words(*report)) say("{}\n", line);
}

/// Drives the boxes and records; `info` is complete.
template <class SomeBoxes>
int run_boxes(SomeBoxes& boxes, const RunInfo& info, const LoadedScenario& loaded, const std::string& out,
              const Options& options) {
  heed_signals();
  Recorder recorder(out, info);
  std::optional<FramePictures> pictures;
  if (options.save_frames) pictures.emplace(recorder.path(), info.patch_size_px);
  std::optional<ObservabilityWatch> watch;
  if (loaded.scenario.run.observability && info.vehicles == 0) watch.emplace();

  Ending ending =
      drive(boxes, recorder, pictures ? &*pictures : nullptr, watch ? &*watch : nullptr, options.realtime);
  const PointsSettings& points = loaded.scenario.team.points;
  if (ending.saw_nothing && info.vehicles > 0 && (points.count > 0 || !points.file.empty()))
    ending.warnings.push_back("nothing was seen in the whole run");
  if (watch) tell_observability(*watch, recorder);
  const auto finishing = [&](const std::filesystem::path& directory) {
    std::vector<std::string> warnings = ending.warnings;
    if (options.no_figures) return warnings;
    for (std::string& warning : draw_run_figures(directory)) warnings.push_back(std::move(warning));
    return warnings;
  };
  for (const std::string& warning : ending.warnings) say("{}\n", warning);
  const RunOutcome outcome = recorder.finish(ending.status, ending.reason, finishing);
  say("{}{}{}: see {}\n", name(outcome.status), outcome.reason.empty() ? "" : ", ", outcome.reason, out);
  return outcome.status == RunStatus::done ? 0 : 1;
}

int run_camera(const LoadedScenario& loaded, const std::string& out, const Options& options) {
  Assembly assembly = assemble(loaded);
  for (const std::string& line : assembly.notes) say("{}\n", line);
  if (!assembly.scale_is_known) say("no target: the scale is not observable, lengths are relative\n");
  RunInfo info = info_of(loaded);
  // A recording's truth is in its own world, which a target need not share
  const bool own_frame = loaded.scenario.run.world == "recording";
  info.ate_alignment = !assembly.scale_is_known ? "sim3" : own_frame ? "se3" : "none";
  return run_boxes(assembly.boxes, info, loaded, out, options);
}

int run_vehicle(const LoadedScenario& loaded, const std::string& out, const Options& options) {
  if (options.save_frames)
    throw InputError("--save-frames: there are no images with run.sensor = range-bearing");
  PlanarAssembly assembly = assemble_planar(loaded);
  for (const std::string& line : assembly.notes) say("{}\n", line);
  if (!assembly.frame_is_fixed)
    say("no anchors: place and heading are not observable, the map is about where the vehicle started\n");
  RunInfo info = info_of(loaded);
  info.body = "vehicle";
  info.ranges = true;
  info.ate_alignment = assembly.frame_is_fixed ? "none" : "se3";
  return run_boxes(assembly.boxes, info, loaded, out, options);
}

/// What the inputs of a motion are called.
std::vector<std::string> inputs_of(const std::string& model) {
  if (model == "monobot") return {"speed_m_s"};
  if (model == "ackermann") return {"speed_m_s", "steering_rad"};
  if (model != "free-camera") return {"speed_m_s", "turn_rate_rad_s"};
  return {"ax_m_s2", "ay_m_s2", "az_m_s2", "alphax_rad_s2", "alphay_rad_s2", "alphaz_rad_s2"};
}

int run_team(const LoadedScenario& loaded, const std::string& out, const Options& options) {
  if (options.save_frames) throw InputError("--save-frames: there are no images where points are named");
  TeamAssembly assembly = assemble_team(loaded);
  for (const std::string& line : assembly.notes) say("{}\n", line);
  const std::string& model = loaded.scenario.planar.vehicle.model;
  RunInfo info = info_of(loaded);
  info.body = model == "free-camera" ? "camera" : "vehicle";
  info.vehicles = static_cast<int>(assembly.boxes.estimator.settings().members.size());
  info.inputs = inputs_of(model);
  info.steered_m = steered_point(loaded.scenario);
  return run_boxes(assembly.boxes, info, loaded, out, options);
}

int run(const Options& options) {
  std::signal(SIGPIPE, SIG_IGN);  // the record matters more than who listens to how it goes
  if (options.out && options.out->empty()) throw InputError("--out: names nothing; a folder is wanted");
  const LoadedScenario loaded = load(options);
  for (const std::string& line : loaded.overrides) say("{}\n", line);
  const std::string out = options.out.value_or("out/" + loaded.name);
  if (is_team(loaded.scenario)) return run_team(loaded, out, options);
  return loaded.scenario.run.sensor == "camera" ? run_camera(loaded, out, options)
                                                : run_vehicle(loaded, out, options);
}

}  // namespace

CLI::App* add_run(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand("run", "Run the loop from a scenario file");
  auto options = std::make_shared<Options>();
  command->add_option("scenario", options->scenario, "Scenario file, or the name of a built-in one")
      ->capture_default_str();
  command->add_option("--out", options->out, "Run directory [out/<scenario>]")->type_name("DIR");
  command->add_option("--seed", options->seed, "Seed of all randomness")->type_name("N");
  command->add_option("--set", options->sets, "Override a setting, e.g. --set map.wanted_visible=20")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--duration", options->duration_s, "Stop after so many seconds")->type_name("S");
  command->add_flag("--realtime", options->realtime, "No faster than the clock on the wall");
  command->add_flag("--save-frames", options->save_frames,
                    "Write a picture of every frame, ellipses drawn in");
  command->add_flag("--no-figures", options->no_figures, "Leave out the figures");
  command->footer("Example:\n  incognita run room --seed 7 --duration 20 --out out/first\n");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
  return command;
}

}  // namespace incognita
