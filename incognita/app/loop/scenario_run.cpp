#include "incognita/app/loop/scenario_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/association_score.hpp"
#include "incognita/app/loop/interventions.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/app/loop/saved_run.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/recorder.hpp"

namespace incognita {
namespace {

/// How the loop ended.
struct RunConclusion {
  RunStatus status = RunStatus::done;
  std::string reason;
  std::vector<std::string> warnings = {};
  bool between_ticks = true;  ///< false: a tick failed, and what it changed is no state to go on from
};

/// State accumulated over the frames.
struct RunProgress {
  Snapshot last;
  bool ever_tracked = false, ever_measured = false, stopped = false;
  std::int64_t frames = 0, doubted = 0;
  std::string doubt;

  void add(const Snapshot& snapshot, std::vector<Intervention> interventions) {
    last = snapshot;
    last.interventions = std::move(interventions);
    ever_tracked |=
        snapshot.status.state != TrackingState::starting && snapshot.status.state != TrackingState::lost;
    ever_measured |= !snapshot.matches.empty();
    ++frames;
    if (snapshot.status.state == TrackingState::degraded) ++doubted, doubt = snapshot.status.reason;
  }
};

RunConclusion conclusion_of(const RunProgress& progress) {
  const Snapshot& last = progress.last;
  if (progress.stopped) return {RunStatus::interrupted, fmt::format("stopped at t = {:.3f} s", last.tick.t)};
  if (!progress.ever_tracked)
    return {RunStatus::failed,
            "never started: " + (last.status.reason.empty() ? "there was no frame" : last.status.reason)};
  if (last.status.state == TrackingState::lost)
    return {RunStatus::failed, fmt::format("lost at the end: {}", last.status.reason)};
  return {};
}

std::vector<std::string> warnings_of(const RunProgress& progress, const Scenario& s) {
  // Simulated anchors may be out of sight of a path; those of a recording are where the scenario says
  const bool simulated = s.is_simulated(),
             to_see = !simulated || s.points.count > 0 || !s.points.file.empty();
  const Snapshot& last = progress.last;
  std::vector<std::string> warnings;
  const auto unseen =
      std::count_if(last.landmarks.begin(), last.landmarks.end(),
                    [](const SnapshotLandmark& l) { return l.anchor && l.detection_count == 0; });
  if (unseen > 0 && !simulated)
    warnings.push_back(fmt::format("{} anchors were never matched; check their positions", unseen));
  if (to_see && !progress.ever_measured) warnings.push_back("there was no measurement in the whole run");
  constexpr double most_doubted = 0.1;  // share of all frames
  if (static_cast<double>(progress.doubted) > most_doubted * static_cast<double>(progress.frames))
    warnings.push_back(
        fmt::format("degraded in {} of {} frames: {}", progress.doubted, progress.frames, progress.doubt));
  if (last.readout)
    warnings.push_back(fmt::format(
        "the {} of the images seem to be read one after the other, in {:.1f} ms or more: a rolling "
        "shutter, which is not modeled; errors are larger in fast motion",
        last.readout->of_columns ? "columns" : "rows", 1e3 * std::abs(last.readout->s)));
  return warnings;
}

/// What a person did at a tick that failed before its snapshot. The failure itself is what must be told.
void log_failed_tick(const RunProgress& progress, const Interventions& interventions, RunSink& sink) {
  const bool published = progress.frames > 0 && progress.last.tick.frame >= interventions.tick().frame;
  if (published) return;
  try {
    sink.log(interventions.tick(), interventions.taken());
  } catch (const std::exception&) {  // finish() reports a disk that is full
  }
}

/// Nobody intervenes. Settings that were changed before a resumed run was saved are changed again.
class NoInterventions final : public InterventionSource {
 public:
  explicit NoInterventions(const RunSaving& saving) : saving_(saving) {}
  std::vector<Intervention> due(const Tick&) override { return {}; }
  void refused(const Intervention&, const std::string&) override {}
  LoadedScenario reloaded(const std::vector<std::string>& settings) override {
    if (saving_.reload) return saving_.reload(settings);
    throw InputError("settings of the decision were changed during this run, which cannot be repeated here");
  }

 private:
  const RunSaving& saving_;
};

/// Saves the state of a run where it is wanted.
class Saver {
 public:
  Saver(const LoadedScenario& loaded, RunState& run, const RunCallbacks& callbacks)
      : loaded_(loaded), run_(run), saving_(callbacks.saving), report_(callbacks.report) {}

  /// A state that cannot be saved is refused before the first frame.
  void check() {
    if (saving_.write) saved_run(loaded_, run_, saved_clock(*run_.parts.clock), INCOGNITA_VERSION);
  }

  /// After each frame. A state that cannot be written must not end the run: it is tried again when the next save is due.
  void frame_done() {
    if (!saving_.write) return;
    clock_ = saved_clock(*run_.parts.clock);
    const bool requested = is_requested();
    if (is_due(run_.loop.tick.t) || requested) try_to_save(requested);
  }

  /// While the loop waits between two frames.
  void save_if_requested() {
    if (clock_ && is_requested()) try_to_save(true);
  }

  /// Throws RecordError.
  void save_end() {
    if (!clock_) return;
    const bool requested = is_requested();
    try {
      save(requested);
    } catch (const RecordError& error) {
      report_failure(error.what());
      throw;
    }
  }

 private:
  bool is_requested() const { return saving_.is_requested && saving_.is_requested(); }

  void try_to_save(bool requested) {
    try {
      save(requested);
    } catch (const RecordError& error) {
      report_(error.what());
      report_failure(error.what());
    }
  }

  void save(bool requested) {
    const auto start = std::chrono::steady_clock::now();
    const std::string bytes = saved_run(loaded_, run_, *clock_, INCOGNITA_VERSION);
    saving_.write(bytes);
    if (!requested) return;
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    report_(fmt::format("saved at t = {:.3f} s: {:.1f} MB in {:.0f} ms", run_.loop.tick.t,
                        1e-6 * static_cast<double>(bytes.size()), ms.count()));
    if (saving_.on_save) saving_.on_save({run_.loop.tick.t, bytes.size(), ""});
  }

  void report_failure(const std::string& why) const {
    if (saving_.on_save) saving_.on_save({run_.loop.tick.t, 0, why});
  }

  bool is_due(double t) {
    const double every_s = loaded_.scenario.run.save_every_s;
    if (!due_t_) due_t_ = t + every_s;
    if (every_s == 0 || !has_come(*due_t_, t)) return false;
    due_t_ = t + every_s;
    return true;
  }

  const LoadedScenario& loaded_;
  RunState& run_;
  const RunSaving& saving_;
  const std::function<void(const std::string&)>& report_;
  std::optional<std::string> clock_;  ///< its state at the end of the last frame, of a run that is saved
  std::optional<double> due_t_;
};

/// Follows the estimate with the observability monitor, if the run has one.
std::function<void(const Estimate&)> watch_of(RunState& run, const RunCallbacks& callbacks) {
  if (!run.watch) return {};
  return [&run, &callbacks](const Estimate& estimate) {
    run.watch->follow(estimate);
    if (callbacks.observe) callbacks.observe(*run.watch);
  };
}

RunConclusion drive(RunState& run, Saver& saver, RunSink& sink, bool intervenes,
                    const RunCallbacks& callbacks, const Scenario& scenario) {
  RunProgress progress;
  progress.last.tick = run.loop.tick;
  progress.ever_tracked = run.ever_tracked;
  progress.ever_measured = run.ever_measured;
  const auto publish = [&](const Snapshot& snapshot) {
    progress.add(snapshot, run.interventions.taken());
    if (run.score) run.score->add(snapshot);
    sink.publish(progress.last);
  };
  bool in_tick = false;  // the source of images may fail between two ticks, when the state is whole
  const auto keep_going = [&](const Tick& tick) {
    progress.stopped = callbacks.keep_going && !callbacks.keep_going(tick);
    in_tick = !progress.stopped;
    if (!progress.stopped) run.interventions.apply_due(tick);
    return !progress.stopped;
  };
  const auto done = [&] {
    in_tick = false;
    run.ever_tracked = progress.ever_tracked;
    run.ever_measured = progress.ever_measured;
    saver.frame_done();
  };
  try {
    run_loop(run.parts, run.loop, publish, keep_going, watch_of(run, callbacks), done);
  } catch (const std::exception& error) {
    if (intervenes) log_failed_tick(progress, run.interventions, sink);
    return {RunStatus::failed,
            fmt::format("at frame {}: {}", progress.last.tick.frame + 1, error.what()),
            {},
            !in_tick};
  }
  // The clock of a camera or robot ends when the run is to end, without a further tick
  progress.stopped |= (scenario.is_robot() || scenario.is_live()) && callbacks.is_over && callbacks.is_over();
  RunConclusion conclusion = conclusion_of(progress);
  conclusion.warnings = warnings_of(progress, scenario);
  return conclusion;
}

/// A run whose state cannot be written has failed, as with any other file.
void save_end(Saver& saver, RunConclusion& conclusion) {
  try {
    saver.save_end();
  } catch (const std::exception& error) {
    if (conclusion.status == RunStatus::done)
      conclusion = {RunStatus::failed, error.what(), conclusion.warnings};
    conclusion.warnings.emplace_back(error.what());
  }
}

void note(const AssociationScore& score, RunSink& sink) {
  sink.note("matches_right", score.right());
  sink.note("matches_wrong", score.wrong());
  sink.note("matches_missed", score.missed());
  sink.note("duplicate_landmarks", std::int64_t{score.duplicate_landmarks()});
}

void begin(LiveFeed& live, const RunCallbacks& callbacks) {
  live.report_to(callbacks.report);
  if (callbacks.is_over) live.end_when(callbacks.is_over);
}

}  // namespace

RunOutcome run_scenario(const LoadedScenario& loaded, const SinkFactory& open,
                        const RunCallbacks& callbacks) {
  Assembly assembly = assemble(loaded, callbacks.live_sources);
  assembly.info.version = INCOGNITA_VERSION;
  for (const std::string& line : assembly.notes) callbacks.report(line);
  std::optional<ObservabilityWatch> watch;
  if (loaded.scenario.run.observability && loaded.scenario.has_observability_report()) watch.emplace();
  std::optional<AssociationScore> score;
  if (assembly.association_truth) score.emplace(assembly.association_truth);
  NoInterventions nobody(callbacks.saving);
  InterventionSource& source = callbacks.interventions ? *callbacks.interventions : nobody;
  Interventions interventions(assembly.parts, loaded.scenario, source);
  LoopState loop;
  RunState run{assembly.parts, loop, interventions, watch ? &*watch : nullptr, score ? &*score : nullptr};
  if (callbacks.saving.resumed) restore_run(*callbacks.saving.resumed, run);
  if (assembly.robot) interventions.give_back_all();  // who drove a real robot is gone
  if (callbacks.saving.map) restore_map(*callbacks.saving.map, loaded, run);
  Saver saver(loaded, run, callbacks);
  saver.check();
  const std::unique_ptr<RunSink> sink = open(assembly.info, assembly.parts.clock->expected_frames());
  if (assembly.live) begin(*assembly.live, callbacks);
  if (assembly.robot && callbacks.robot) callbacks.robot(assembly.robot);
  if (callbacks.saving.resumed) sink->note("resumed_at_s", loop.tick.t);
  if (callbacks.saving.may_wait) callbacks.saving.may_wait([&saver] { saver.save_if_requested(); });
  RunConclusion conclusion =
      drive(run, saver, *sink, callbacks.interventions != nullptr, callbacks, loaded.scenario);
  if (conclusion.between_ticks) save_end(saver, conclusion);
  if (assembly.live)
    for (const auto& [name, count] : assembly.live->counts()) sink->note(name, count);
  if (score) note(*score, *sink);
  if (watch)
    if (const auto report = watch->report()) sink->note(*report, in_words(*report));
  return sink->finish(conclusion.status, conclusion.reason, conclusion.warnings);
}

}  // namespace incognita
