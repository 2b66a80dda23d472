#include "incognita/app/loop/scenario_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/association_score.hpp"
#include "incognita/app/loop/interventions.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/record/recorder.hpp"

namespace incognita {
namespace {

/// How the loop ended.
struct RunConclusion {
  RunStatus status = RunStatus::done;
  std::string reason;
  std::vector<std::string> warnings = {};
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
  if (!progress.ever_tracked) return {RunStatus::failed, "never started: " + last.status.reason};
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

RunConclusion drive(LoopParts& parts, RunSink& sink, ObservabilityWatch* watch, AssociationScore* score,
                    const RunCallbacks& callbacks, const Scenario& scenario) {
  RunProgress progress;
  std::optional<Interventions> interventions;
  if (callbacks.interventions) interventions.emplace(parts, scenario, *callbacks.interventions);
  const auto publish = [&](const Snapshot& snapshot) {
    progress.add(snapshot, interventions ? interventions->taken() : std::vector<Intervention>{});
    if (score) score->add(snapshot);
    sink.publish(progress.last);
  };
  const auto keep_going = [&](const Tick& tick) {
    progress.stopped = callbacks.keep_going && !callbacks.keep_going(tick);
    if (interventions && !progress.stopped) interventions->apply_due(tick);
    return !progress.stopped;
  };
  std::function<void(const Estimate&)> watching;
  if (watch)
    watching = [&](const Estimate& estimate) {
      watch->follow(estimate);
      if (callbacks.observe) callbacks.observe(*watch);
    };
  try {
    run_loop(parts, publish, keep_going, watching);
  } catch (const std::exception& error) {
    if (interventions) log_failed_tick(progress, *interventions, sink);
    return {RunStatus::failed, fmt::format("at frame {}: {}", progress.last.tick.frame + 1, error.what())};
  }
  // The clock of a robot ends when the run is to end, without a further tick
  progress.stopped |= scenario.is_robot() && callbacks.is_over && callbacks.is_over();
  RunConclusion conclusion = conclusion_of(progress);
  conclusion.warnings = warnings_of(progress, scenario);
  return conclusion;
}

void note(const AssociationScore& score, RunSink& sink) {
  sink.note("matches_right", score.right());
  sink.note("matches_wrong", score.wrong());
  sink.note("matches_missed", score.missed());
  sink.note("duplicate_landmarks", std::int64_t{score.duplicate_landmarks()});
}

void begin(RobotFeed& robot, const RunCallbacks& callbacks) {
  robot.report_to(callbacks.report);
  if (callbacks.is_over) robot.end_when(callbacks.is_over);
  if (callbacks.robot) callbacks.robot(robot.link());
}

}  // namespace

RunOutcome run_scenario(const LoadedScenario& loaded, const SinkFactory& open,
                        const RunCallbacks& callbacks) {
  Assembly assembly = assemble(loaded);
  assembly.info.version = INCOGNITA_VERSION;
  for (const std::string& line : assembly.notes) callbacks.report(line);
  const std::unique_ptr<RunSink> sink = open(assembly.info, assembly.parts.clock->expected_frames());
  if (assembly.robot) begin(*assembly.robot, callbacks);
  std::optional<ObservabilityWatch> watch;
  if (loaded.scenario.run.observability && loaded.scenario.has_observability_report()) watch.emplace();
  std::optional<AssociationScore> score;
  if (assembly.association_truth) score.emplace(assembly.association_truth);
  const RunConclusion conclusion = drive(assembly.parts, *sink, watch ? &*watch : nullptr,
                                         score ? &*score : nullptr, callbacks, loaded.scenario);
  if (assembly.robot)
    for (const auto& [name, count] : assembly.robot->counts()) sink->note(name, count);
  if (score) note(*score, *sink);
  if (watch)
    if (const auto report = watch->report()) sink->note(*report, in_words(*report));
  return sink->finish(conclusion.status, conclusion.reason, conclusion.warnings);
}

}  // namespace incognita
