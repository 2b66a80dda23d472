#include "incognita/app/loop/scenario_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "incognita/app/loop/assemble.hpp"
#include "incognita/app/loop/assemble_ranges.hpp"
#include "incognita/app/loop/assemble_room_vehicle.hpp"
#include "incognita/app/loop/assemble_team.hpp"
#include "incognita/app/loop/association_score.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/app/loop/team_models.hpp"
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

  void add(const Snapshot& snapshot) {
    last = snapshot;
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

/// `to_see`: whether the scene contains landmarks.
std::vector<std::string> warnings_of(const RunProgress& progress, bool to_see) {
  const Snapshot& last = progress.last;
  std::vector<std::string> warnings;
  const auto unseen =
      std::count_if(last.landmarks.begin(), last.landmarks.end(),
                    [](const SnapshotLandmark& l) { return l.anchor && l.detection_count == 0; });
  if (unseen > 0 && last.vehicles.empty())
    warnings.push_back(fmt::format("{} anchors were never matched; check their positions", unseen));
  if (to_see && !last.vehicles.empty() && !progress.ever_measured)
    warnings.push_back("there was no measurement in the whole run");
  constexpr double most_doubted = 0.1;  // share of all frames
  if (static_cast<double>(progress.doubted) > most_doubted * static_cast<double>(progress.frames))
    warnings.push_back(
        fmt::format("degraded in {} of {} frames: {}", progress.doubted, progress.frames, progress.doubt));
  return warnings;
}

RunConclusion drive(LoopParts& parts, RunSink& sink, ObservabilityWatch* watch, AssociationScore* score,
                    const RunCallbacks& callbacks, bool to_see, bool with_vehicles) {
  RunProgress progress;
  const auto publish = [&](Snapshot snapshot) {
    if (!with_vehicles) snapshot.vehicles.clear();
    progress.add(snapshot);
    if (score) score->add(snapshot);
    sink.publish(snapshot);
  };
  const auto keep_going = [&](const Tick& tick) {
    progress.stopped = callbacks.keep_going && !callbacks.keep_going(tick);
    return !progress.stopped;
  };
  std::function<void(const Estimate&)> watching;
  if (watch) watching = [watch](const Estimate& estimate) { watch->follow(estimate); };
  try {
    run_loop(parts, publish, keep_going, watching);
  } catch (const std::exception& error) {
    return {RunStatus::failed, fmt::format("at frame {}: {}", progress.last.tick.frame + 1, error.what())};
  }
  RunConclusion conclusion = conclusion_of(progress);
  conclusion.warnings = warnings_of(progress, to_see);
  return conclusion;
}

RunInfo info_of(const LoadedScenario& loaded) {
  RunInfo info;
  info.effective_toml = effective_toml(loaded);
  info.seed = loaded.scenario.run.seed;
  info.version = INCOGNITA_VERSION;
  info.patch_size_px = loaded.scenario.slam.search.patch_size_px;
  return info;
}

void note(const AssociationScore& score, RunSink& sink) {
  sink.note("matches_right", score.right());
  sink.note("matches_wrong", score.wrong());
  sink.note("matches_missed", score.missed());
  sink.note("duplicate_landmarks", std::int64_t{score.duplicate_landmarks()});
}

/// Runs the loop; `info` is complete. `score` is set if the estimator gets detections without identity.
RunOutcome run_parts(LoopParts& parts, const RunInfo& info, const LoadedScenario& loaded,
                     const SinkFactory& open, const RunCallbacks& callbacks,
                     std::optional<AssociationScore> score = std::nullopt) {
  const std::unique_ptr<RunSink> sink = open(info, parts.clock->expected_frames());
  std::optional<ObservabilityWatch> watch;
  if (loaded.scenario.run.observability && info.vehicles == 0) watch.emplace();
  const PointsSettings& points = loaded.scenario.points;
  const bool to_see = points.count > 0 || !points.file.empty();
  const RunConclusion conclusion = drive(parts, *sink, watch ? &*watch : nullptr, score ? &*score : nullptr,
                                         callbacks, to_see, info.vehicles > 0);
  if (score) note(*score, *sink);
  if (watch)
    if (const auto report = watch->report()) sink->note(*report, in_words(*report));
  return sink->finish(conclusion.status, conclusion.reason, conclusion.warnings);
}

RunOutcome run_camera(const LoadedScenario& loaded, const SinkFactory& open, const RunCallbacks& callbacks) {
  Assembly assembly = assemble(loaded);
  for (const std::string& line : assembly.notes) callbacks.report(line);
  if (!assembly.scale_is_known)
    callbacks.report("no target: the scale is unobservable, lengths are in arbitrary units");
  RunInfo info = info_of(loaded);
  // The frame of a recording's truth may differ from that of the target.
  const bool own_frame = loaded.scenario.is_recording();
  info.ate_alignment = !assembly.scale_is_known ? "sim3" : own_frame ? "se3" : "none";
  return run_parts(assembly.parts, info, loaded, open, callbacks);
}

RunOutcome run_room_vehicle(const LoadedScenario& loaded, const SinkFactory& open,
                            const RunCallbacks& callbacks) {
  RoomVehicleAssembly assembly = assemble_room_vehicle(loaded);
  if (!assembly.scale_is_known)
    callbacks.report("no target: the scale is unobservable, lengths are in arbitrary units");
  RunInfo info = info_of(loaded);
  info.ate_alignment = assembly.scale_is_known ? "none" : "sim3";
  return run_parts(assembly.parts, info, loaded, open, callbacks);
}

RunOutcome run_vehicle(const LoadedScenario& loaded, const SinkFactory& open, const RunCallbacks& callbacks) {
  RangeAssembly assembly = assemble_ranges(loaded);
  for (const std::string& line : assembly.notes) callbacks.report(line);
  if (!assembly.frame_is_fixed)
    callbacks.report(
        "no anchors: position and heading are unobservable, the map is relative to the start of the vehicle");
  RunInfo info = info_of(loaded);
  info.body = "vehicle";
  info.ranges = true;
  info.ate_alignment = assembly.frame_is_fixed ? "none" : "se3";
  info.truth_recorded = !assembly.recording().truth.empty();
  info.warnings = assembly.warnings;
  info.survey = survey_of(assembly.recording(), loaded.scenario.planar.association.method ==
                                                    DataAssociationSettings::Method::known);
  return run_parts(assembly.parts, info, loaded, open, callbacks);
}

/// Names of a motion model's inputs.
std::vector<std::string> inputs_of(const MotionTraits& motion) {
  std::vector<std::string> names;
  for (const Quantity& input : motion.input) names.push_back(input.key());
  return names;
}

RunOutcome run_team(const LoadedScenario& loaded, const SinkFactory& open, const RunCallbacks& callbacks) {
  TeamAssembly assembly = assemble_team(loaded);
  for (const std::string& line : assembly.notes) callbacks.report(line);
  const MotionTraits& motion = loaded.scenario.motion();
  RunInfo info = info_of(loaded);
  info.body = motion.in_space() ? "camera" : "vehicle";
  info.vehicles = static_cast<int>(assembly.estimator.bodies.size());
  info.inputs = inputs_of(loaded.scenario.has_carried_camera() ? motion_traits<TerrainVehicle> : motion);
  info.steered_m = steered_point(loaded.scenario);
  info.survey = std::move(assembly.survey);
  info.warnings = std::move(assembly.warnings);
  std::optional<AssociationScore> score;
  if (assembly.association_truth) score.emplace(assembly.association_truth);
  return run_parts(assembly.parts, info, loaded, open, callbacks, std::move(score));
}

}  // namespace

RunOutcome run_scenario(const LoadedScenario& loaded, const SinkFactory& open,
                        const RunCallbacks& callbacks) {
  if (loaded.scenario.is_team()) return run_team(loaded, open, callbacks);
  if (loaded.scenario.is_room_vehicle()) return run_room_vehicle(loaded, open, callbacks);
  return loaded.scenario.sensor.type == "camera" ? run_camera(loaded, open, callbacks)
                                                 : run_vehicle(loaded, open, callbacks);
}

}  // namespace incognita
