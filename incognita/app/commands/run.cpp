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
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "incognita/app/commands/page_options.hpp"
#include "incognita/app/commands/recorder_sink.hpp"
#include "incognita/app/console/interrupt.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/console/save_request.hpp"
#include "incognita/app/loop/intervention_log.hpp"
#include "incognita/app/loop/saved_run.hpp"
#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/app/view/live_page.hpp"
#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/durable_file.hpp"
#include "incognita/record/files/state_file.hpp"
#include "incognita/record/replay/recorded_run.hpp"
#include "incognita/record/snapshot/interventions.hpp"
#include "incognita/world/live/robot_link.hpp"

namespace incognita {
namespace {

struct RunOptions {
  std::string scenario = "room";
  std::optional<std::string> out;
  std::vector<std::string> sets;
  std::optional<std::string> seed, duration_s;  // parsed by the setting
  bool scenario_given = false;
  bool realtime = false;
  bool save_frames = false;
  bool save_recording = false;
  bool no_figures = false;
  std::vector<std::string> view;  // the port, if the page is wanted
  PageOptions page;
  std::optional<std::string> replay_commands;
  std::optional<std::string> resume;
  bool relocalize = false;
  std::shared_ptr<const StateFile> saved;  // what that file holds
};

constexpr std::size_t largest_settings = std::size_t{1} << 20;

/// An interrupt ends the loop after the current frame; files are closed and figures drawn.
void handle_signals() {
  catch_interrupts();
  catch_save_signal();
  std::signal(SIGXFSZ, SIG_IGN);  // makes a full disk a reported error
}

LoadedScenario load(const RunOptions& options, const std::vector<std::string>& further = {}) {
  std::vector<Flag> flags;
  if (options.seed) flags.push_back({"run.seed", *options.seed, "--seed"});
  if (options.duration_s) flags.push_back({"run.duration_s", *options.duration_s, "--duration"});
  if (options.saved && !options.relocalize) return scenario_of(*options.saved, options.sets, flags, further);
  std::vector<std::string> sets = options.sets;
  sets.insert(sets.end(), further.begin(), further.end());
  return load_scenario(options.scenario, sets, flags);
}

/// Sleeps in short intervals, so that an interrupt is handled soon even at a low frame rate.
void wait_until(std::chrono::steady_clock::time_point start, double t_s) {
  constexpr double nap_s = 0.05;
  for (;;) {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    const double left_s = t_s - waited.count();
    if (interrupted() || left_s <= 0) return;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, nap_s)));
  }
}

void refuse_pictures_without_images(const char* option, const Scenario& scenario) {
  if (scenario.is_team())
    throw InputError(fmt::format("{}: there are no images with world.type = points", option));
  if (scenario.sensor.type != "camera")
    throw InputError(fmt::format("{}: there are no images with sensor.type = range-bearing", option));
}

/// Repeats the interventions of an earlier run at their ticks.
class LoggedInterventions final : public InterventionSource {
 public:
  LoggedInterventions(const std::string& run, const RunOptions& options)
      : log_(read_intervention_log(std::filesystem::path(run))), options_(options) {}

  std::vector<Intervention> due(const Tick& tick) override {
    std::vector<Intervention> now;
    while (next_ < log_.size() && log_[next_].frame <= tick.frame) now.push_back(log_[next_++].intervention);
    return now;
  }
  void refused(const Intervention& intervention, const std::string& why) override {
    throw InputError(fmt::format("--replay-commands: {}: {}", name(intervention), why));
  }
  LoadedScenario reloaded(const std::vector<std::string>& settings) override {
    return load(options_, settings);
  }

  std::size_t left() const { return log_.size() - next_; }

 private:
  std::vector<LoggedIntervention> log_;
  RunOptions options_;
  std::size_t next_ = 0;
};

void check(const RunOptions& options) {
  if (options.scenario.empty())
    throw InputError("the scenario is empty; a file or the name of a built-in one is required");
  if (options.out && options.out->empty()) throw InputError("--out: is empty; a folder is required");
  const PageOptions& page = options.page;
  if (options.view.empty() && (page.address || !page.allowed_origins.empty() || page.https))
    throw InputError("--view-address, --allow-origin and --https: only with --view");
  if (options.replay_commands && !options.view.empty())
    throw InputError("--replay-commands and --view: only one of them at a time");
  if (options.relocalize && !options.resume) throw InputError("--relocalize: only with --resume");
  if (!options.resume) return;
  if (options.relocalize && !options.scenario_given)
    throw InputError("--relocalize: name the scenario of the run that uses the map");
  if (options.scenario_given && !options.relocalize)
    throw InputError(fmt::format(
        "--resume: the scenario is that of {}; leave out `{}`, or use the map alone, with --relocalize",
        *options.resume, options.scenario));
  if (options.replay_commands) throw InputError("--resume and --replay-commands: only one of them at a time");
}

/// The scenario; without one, with the commands of an earlier run, the settings and the name of that run.
LoadedScenario load_or_repeat(RunOptions& options) {
  if (!options.replay_commands || options.scenario_given) return load(options);
  const std::filesystem::path settings = std::filesystem::path(*options.replay_commands) / "effective.toml";
  if (!file_exists(settings))
    throw InputError(
        fmt::format("--replay-commands: {} is missing; name a run directory", settings.string()));
  options.scenario = settings.string();
  LoadedScenario loaded = load(options);
  if (loaded.overrides.empty()) loaded.settings_of_repeated_run = read_file(settings, largest_settings);
  const std::string info = RecordedRun(*options.replay_commands).info_json();
  loaded.name = nlohmann::json::parse(info).value("scenario", loaded.name);
  return loaded;
}

/// replay.toml: the scenario that repeats a live run from its images.
void write_replay(const LoadedScenario& loaded, const std::string& out) {
  write_whole_file(std::filesystem::path(out) / "replay.toml", replay_toml(loaded, "recording"));
}

/// Writes the state of the run beside its tables.
void save_into(RunSaving& saving, const RunOptions& options, const std::filesystem::path& out) {
  saving.is_requested = take_save_request;
  saving.write = [file = out / state_file_name](const std::string& bytes) { write_durably(file, bytes); };
  (options.relocalize ? saving.map : saving.resumed) = options.saved.get();
  saving.reload = [options](const std::vector<std::string>& settings) { return load(options, settings); };
}

/// The page takes part in the run.
void connect_page(LivePage& page, RunCallbacks& callbacks) {
  callbacks.live_sources.browser = page.camera();
  callbacks.interventions = &page;
  callbacks.robot = [&page](const std::shared_ptr<RobotLink>& robot) {
    page.control().set_robot([held = std::weak_ptr(robot)](bool stopped) {
      if (const auto link = held.lock()) link->set_stopped(stopped);
    });
  };
  callbacks.observe = [&page](const ObservabilityWatch& watch) { page.observe(watch); };
  callbacks.saving.on_save = [&page](const SaveReport& report) { page.saved(report, state_file_name); };
}

/// Of a viewer who asked while the last files were written.
void refuse_late_save(LivePage& page) {
  page.control().set_saving({});
  if (take_save_request()) page.saved({0, 0, "the run has ended"}, state_file_name);
}

/// One run from its start to its end. `page`: null without one.
RunOutcome run_once(const RunOptions& options, const LoadedScenario& loaded, const std::string& out,
                    LivePage* page) {
  for (const std::string& line : loaded.overrides) print_message("{}\n", line);
  if (options.save_frames) refuse_pictures_without_images("--save-frames", loaded.scenario);
  if (options.save_recording) refuse_pictures_without_images("--save-recording", loaded.scenario);
  // What a camera saw cannot be had again
  const bool save_recording = options.save_recording || loaded.scenario.is_live();
  std::optional<LoggedInterventions> logged;
  if (options.replay_commands) logged.emplace(*options.replay_commands, options);
  std::optional<double> first_t;
  std::chrono::steady_clock::time_point start;
  double wall_s = 0;
  std::function<void()> save_if_requested;
  RunCallbacks callbacks;
  callbacks.report = [](const std::string& line) { print_message("{}\n", line); };
  callbacks.keep_going = [&](const Tick& tick) {
    if (!first_t) first_t = tick.t, start = std::chrono::steady_clock::now();
    if (page) return page->control().wait_for(tick, save_if_requested);
    if (options.realtime && !loaded.scenario.is_live()) wait_until(start, tick.t - *first_t);
    return !interrupted();
  };
  callbacks.is_over = [page] { return page ? page->control().is_ending() : interrupted(); };
  save_into(callbacks.saving, options, out);
  if (logged) callbacks.interventions = &*logged;
  callbacks.saving.may_wait = [&](std::function<void()> save) { save_if_requested = std::move(save); };
  if (page) connect_page(*page, callbacks);
  const auto frame_done = [&](const Snapshot& snapshot) {
    if (page) page->publish(snapshot);
    wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const SinkFactory open = [&](const RunInfo& info, std::int64_t frames) {
    handle_signals();
    auto sink = std::make_unique<RecorderSink>(
        RecorderSink::Options{out, options.save_frames, save_recording, !options.no_figures, frame_done},
        info, frames);
    remove_partial_files(out);  // of a run that was killed while it saved
    if (loaded.scenario.is_live()) write_replay(loaded, out);
    if (page) page->begin(info, frames);
    take_save_request();  // of an earlier run
    if (page) page->control().set_saving(request_save);
    return sink;
  };
  const RunOutcome outcome = run_scenario(loaded, open, callbacks);
  if (page) refuse_late_save(*page);
  if (logged && logged->left() > 0)
    print_message("--replay-commands: the run ended before the frames of the last {} commands\n",
                  logged->left());
  if (outcome.status != RunStatus::done)
    print_message("{}{}{}: see {}\n", name(outcome.status), outcome.reason.empty() ? "" : ", ",
                  outcome.reason, out);
  std::fputs(in_words(outcome.report, wall_s, out).c_str(), stdout);
  std::fflush(stdout);
  return outcome;
}

bool same_folder(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code missing;
  return std::filesystem::equivalent(a, b, missing);
}

/// Whether `inner` is `outer` or in it.
bool is_inside(const std::filesystem::path& inner, const std::filesystem::path& outer) {
  std::error_code error;
  const std::filesystem::path a = std::filesystem::weakly_canonical(outer, error),
                              b = std::filesystem::weakly_canonical(inner, error);
  return !error && std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first == a.end();
}

bool holds_recording_of(const std::filesystem::path& out, const LoadedScenario& loaded) {
  if (!loaded.scenario.is_recording()) return false;
  try {
    return is_inside(find_data(loaded.scenario.recording.folder, loaded.file, ""), out);
  } catch (const InputError&) {
    return false;  // reported by the reader of the recording
  }
}

/// Why a run may not replace the files in that folder; empty if it may.
std::string why_kept(const std::filesystem::path& out, const RunOptions& options,
                     const LoadedScenario& loaded) {
  std::error_code missing;
  if (options.replay_commands && same_folder(out, *options.replay_commands))
    return "is the run whose commands are repeated";
  if (options.resume && same_folder(out, std::filesystem::absolute(*options.resume).parent_path()))
    return "is the run that is resumed";
  if (holds_recording_of(out, loaded)) return "holds the recording of this run";
  if (loaded.scenario.is_live() && std::filesystem::exists(out / "recording", missing))
    return "holds what a camera saw in an earlier run, which cannot be had again";
  return "";
}

/// Never one whose files cannot be had again.
std::string output_folder(const RunOptions& options, const LoadedScenario& loaded) {
  std::string out = options.out.value_or("out/" + loaded.name);
  if (options.out) {
    if (const std::string why = why_kept(out, options, loaded); !why.empty())
      throw InputError(fmt::format("--out: {} {}; choose another folder", out, why));
    return out;
  }
  if (options.resume && !options.relocalize) out += "-resumed";
  const std::string first = out;
  for (int number = 2; !why_kept(out, options, loaded).empty(); ++number)
    out = loaded.scenario.is_live() ? fmt::format("{}-{}", first, number)
                                    : out + (options.resume ? "-resumed" : "-again");
  return out;
}

int exit_code(const RunOutcome& outcome) { return outcome.status == RunStatus::done ? 0 : 1; }

/// Folder of a run that is started from the page, out/room-2, out/room-3, ...: the first from `number` on whose files may be
/// replaced. `first`: the options that the program was started with.
std::string next_folder(const std::string& out, int& number, const RunOptions& first,
                        const LoadedScenario& loaded) {
  std::string folder;
  do folder = fmt::format("{}-{}", out, number++);
  while (!why_kept(folder, first, loaded).empty());
  return folder;
}

/// Runs until the program is interrupted; each run after the first is started from the page.
int run_with_page(RunOptions options) {
  handle_signals();
  LoadedScenario loaded = load(options);
  const std::string out = output_folder(options, loaded);
  LivePage page(server_settings(options.page), options.scenario, [] { return interrupted(); });
  print_message("the page is at {}\n{}", page.address(),
                hint_for_other_machines(options.page, page.address()));
  open_in_browser(page.address());
  const RunOptions first = options;
  int code = 0, number = 2;
  for (int run = 1;; ++run) {
    try {
      if (run > 1) loaded = load(options);
      const std::string folder = run == 1 ? out : next_folder(out, number, first, loaded);
      page.prepare(
          loaded, [options](const std::vector<std::string>& settings) { return load(options, settings); },
          folder);
      const RunOutcome outcome = run_once(options, loaded, folder, &page);
      code = exit_code(outcome);
      page.end(outcome);
      if (!interrupted()) print_message("the page stays at {} until Ctrl-C\n", page.address());
    } catch (const InputError& error) {
      if (run == 1) throw;
      print_message("incognita: {}\n", error.what());
      page.refuse_start(error.what());
    }
    const std::optional<StartRun> start = page.control().wait_for_start();
    if (!start) return code;
    options.scenario = start->scenario;
    options.sets = start->settings;
    options.seed.reset(), options.duration_s.reset();
    options.resume.reset(), options.saved.reset(), options.relocalize = false;
  }
}

int run(RunOptions options) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed output pipe must not end the run
  if (options.page.phone && options.view.empty()) options.view = {"0"};
  check(options);
  catch_save_signal();
  if (options.resume) options.saved = std::make_shared<const StateFile>(read_state_file(*options.resume));
  if (!options.view.empty()) {
    options.page.port = options.view.back();
    return run_with_page(options);
  }
  const LoadedScenario loaded = load_or_repeat(options);
  return exit_code(run_once(options, loaded, output_folder(options, loaded), nullptr));
}

}  // namespace

CLI::App* add_run(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand("run", "Run the loop from a scenario file");
  auto options = std::make_shared<RunOptions>();
  CLI::Option* const scenario =
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
  command->add_flag("--save-recording", options->save_recording,
                    "Write the images and the true poses as a recording in TUM layout");
  command->add_flag("--no-figures", options->no_figures, "Draw no figures");
  command->add_flag("--view{0}", options->view,
                    "Serve the page: watch and control the run in a browser; =PORT, else any free one");
  add_access_options(*command, options->page);
  command
      ->add_option(
          "--replay-commands", options->replay_commands,
          "Repeat what was done from the page in an earlier run; the scenario is that run's unless one is given")
      ->type_name("RUN");
  command
      ->add_option(
          "--resume", options->resume,
          "Go on from the run.state of an earlier run, as if that had not been interrupted [out/<scenario>-resumed]")
      ->type_name("FILE");
  command->add_flag(
      "--relocalize", options->relocalize,
      "With --resume: use its map alone, in another scenario of the same place; the camera is lost until it recognizes it");
  command->footer(
      "Example:\n  incognita run room --seed 7 --duration 20 --out out/first\n"
      "  incognita run --resume out/first/run.state --duration 40 --out out/second\n"
      "  incognita run explore-room --view\n"
      "  incognita run hand --phone\n");
  command->callback([options, scenario, &job] {
    options->scenario_given = scenario->count() > 0;
    job = [options] { return run(*options); };
  });
  return command;
}

}  // namespace incognita
