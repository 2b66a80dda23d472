#include "incognita/app/commands/run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "incognita/app/console/folder_lock.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/console/progress.hpp"
#include "incognita/app/loop/scenario_run.hpp"
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
  std::optional<std::string> seed, duration_s;  // parsed by the setting
  bool realtime = false;
  bool save_frames = false;
  bool no_figures = false;
};

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// A signal ends the loop after the current frame; files are closed and figures drawn, however often it is sent.
void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, interrupt) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);  // nohup
  }
  std::signal(SIGXFSZ, SIG_IGN);  // makes a full disk a reported error
}

LoadedScenario load(const Options& options) {
  std::vector<Flag> flags;
  if (options.seed) flags.push_back({"run.seed", *options.seed, "--seed"});
  if (options.duration_s) flags.push_back({"run.duration_s", *options.duration_s, "--duration"});
  return load_scenario(options.scenario, options.sets, flags);
}

/// Reports loss and recovery of tracking, and the instructions to an operator, on standard error.
class StateReporter {
 public:
  void report(const Snapshot& s) {
    const bool is_lost = s.status.state == TrackingState::lost;
    if (is_lost && !was_lost_) print_message("t = {:.3f} s: lost: {}\n", s.tick.t, s.status.reason);
    if (!is_lost && was_lost_)
      print_message("t = {:.3f} s: {}: {}\n", s.tick.t, name(s.status.state), s.status.reason);
    was_lost_ = is_lost;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
      const SnapshotDecision& decision = s.bodies[i].decision;
      if (!s.bodies[i].operator_controlled || !decision.decided || decision.chosen < 0) continue;
      const std::string who = s.bodies.size() > 1 ? fmt::format("operator {}: ", i + 1) : "";
      print_message("t = {:.2f} s: {}{}\n", s.tick.t, who, chosen_action(decision));
    }
  }

 private:
  bool was_lost_ = false;
};

/// Sleeps in short intervals, so that an interrupt is handled soon even at a low frame rate.
void wait_until(std::chrono::steady_clock::time_point start, double t_s) {
  constexpr double nap_s = 0.05;
  for (;;) {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    const double left_s = t_s - waited.count();
    if (interrupted || left_s <= 0) return;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, nap_s)));
  }
}

/// Writes the run directory, with pictures if requested, and reports progress on standard error.
class RecorderSink : public RunSink {
 public:
  /// `frame_done` is called at the end of every frame.
  RecorderSink(const std::string& out, const Options& options, const RunInfo& info, std::int64_t frames,
               std::function<void()> frame_done)
      : frame_done_(std::move(frame_done)),
        figures_(!options.no_figures),
        alignment_(alignment_kind(info.ate_alignment).value_or(AlignmentKind::none)),
        lock_(out),
        recorder_(out, info),
        progress_(frames) {
    for (const std::string& warning : info.warnings) print_message("warning: {}\n", warning);
    if (options.save_frames) pictures_.emplace(recorder_.path(), info.patch_size_px);
  }

  void publish(const Snapshot& s) override {
    recorder_.publish(s);
    if (pictures_) pictures_->publish(s);
    progress_->show(s.tick.frame + 1, fmt::format("{}, {} matched, {} landmarks", name(s.status.state),
                                                  s.matched, s.landmarks.size()));
    reporter_.report(s);
    frame_done_();
  }

  void note(const ObservabilityReport& report, const std::vector<std::string>& in_words) override {
    progress_.reset();
    recorder_.note(report);
    for (const std::string& line : in_words) print_message("{}\n", line);
  }

  void note(const std::string& key, const SummaryValue& value) override { recorder_.note(key, value); }

  RunOutcome finish(RunStatus status, const std::string& reason,
                    const std::vector<std::string>& warnings) override {
    progress_.reset();  // removes the progress line
    const auto finishing = [&](const std::filesystem::path& directory) {
      std::vector<std::string> all = warnings;
      if (!figures_) return all;
      for (std::string& warning : draw_run_figures(directory, alignment_)) {
        print_message("{}\n", warning);
        all.push_back(std::move(warning));
      }
      return all;
    };
    for (const std::string& warning : warnings) print_message("{}\n", warning);
    return recorder_.finish(status, reason, finishing);
  }

 private:
  std::function<void()> frame_done_;
  bool figures_;
  AlignmentKind alignment_;
  FolderLock lock_;  ///< acquired before any file of an earlier run is changed
  Recorder recorder_;
  std::optional<FramePictures> pictures_;
  std::optional<Progress> progress_;
  StateReporter reporter_;
};

void refuse_pictures_without_images(const Scenario& scenario) {
  if (scenario.is_team()) throw InputError("--save-frames: there are no images with world.type = points");
  if (scenario.sensor.type != "camera")
    throw InputError("--save-frames: there are no images with sensor.type = range-bearing");
}

int run(const Options& options) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed output pipe must not end the run
  if (options.scenario.empty())
    throw InputError("the scenario is empty; a file or the name of a built-in one is required");
  if (options.out && options.out->empty()) throw InputError("--out: is empty; a folder is required");
  const LoadedScenario loaded = load(options);
  for (const std::string& line : loaded.overrides) print_message("{}\n", line);
  if (options.save_frames) refuse_pictures_without_images(loaded.scenario);
  const std::string out = options.out.value_or("out/" + loaded.name);
  std::optional<double> first_t;
  std::chrono::steady_clock::time_point start;
  double wall_s = 0;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string& line) { print_message("{}\n", line); };
  callbacks.keep_going = [&](const Tick& tick) {
    if (!first_t) first_t = tick.t, start = std::chrono::steady_clock::now();
    if (options.realtime) wait_until(start, tick.t - *first_t);
    return !interrupted;
  };
  const SinkFactory open = [&](const RunInfo& info, std::int64_t frames) {
    handle_signals();
    return std::make_unique<RecorderSink>(out, options, info, frames, [&] {
      wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    });
  };
  const RunOutcome outcome = run_scenario(loaded, open, callbacks);
  if (outcome.status != RunStatus::done)
    print_message("{}{}{}: see {}\n", name(outcome.status), outcome.reason.empty() ? "" : ", ",
                  outcome.reason, out);
  std::fputs(in_words(outcome.report, wall_s, out).c_str(), stdout);
  return outcome.status == RunStatus::done ? 0 : 1;
}

}  // namespace

CLI::App* add_run(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand("run", "Run the loop from a scenario file");
  auto options = std::make_shared<Options>();
  command->add_option("scenario", options->scenario, "Scenario file, or the name of a built-in one")
      ->capture_default_str();
  command->add_option("--out", options->out, "Run directory [out/<scenario>]")->type_name("DIR");
  command->add_option("--seed", options->seed, "Seed of all random streams")->type_name("N");
  command->add_option("--set", options->sets, "Override a setting, e.g. --set map.wanted_visible=20")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--duration", options->duration_s, "Duration of the run")->type_name("S");
  command->add_flag("--realtime", options->realtime, "Not faster than real time");
  command->add_flag("--save-frames", options->save_frames,
                    "Write a picture of every frame with its search ellipses");
  command->add_flag("--no-figures", options->no_figures, "Draw no figures");
  command->footer("Example:\n  incognita run room --seed 7 --duration 20 --out out/first\n");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
  return command;
}

}  // namespace incognita
