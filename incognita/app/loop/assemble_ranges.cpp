#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/world_outline.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/io/recordings/clock_warnings.hpp"
#include "incognita/io/recordings/range_recording.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {
namespace {

void check_vehicle(const LoadedScenario& loaded, const RangeRecording& recording) {
  const std::string& model = loaded.scenario.planar.vehicle.model;
  if (recording.vehicle == model) return;
  throw InputError(fmt::format("{}: vehicle.model = {}: the odometry of this recording is that of `{}`",
                               loaded.source_of("vehicle.model"), model, recording.vehicle));
}

void check_identities(const LoadedScenario& loaded, const RangeRecording& recording) {
  if (loaded.scenario.planar.association.method != DataAssociationSettings::Method::known) return;
  for (const RangeRecording::Scan& scan : recording.scans)
    for (const Detection& detection : scan.detections)
      if (detection.identity != Detection::unknown) return;
  throw InputError(
      fmt::format("{}: association.method = known: no detection of this recording says which landmark it "
                  "is of; take `joint` or `nearest`",
                  loaded.source_of("association.method")));
}

void check_fixes(const LoadedScenario& loaded, const RangeRecording& recording) {
  const PlanarSlamSettings& s = loaded.scenario.planar;
  if (!recording.fixes.empty() || !(s.start.at_first_fix || s.filter.use_fixes)) return;
  const char* key = s.filter.use_fixes ? "estimator.use_fixes" : "start.at_first_fix";
  throw InputError(
      fmt::format("{}: {} = true: no external sensor is in this recording", loaded.source_of(key), key));
}

/// Refuses a duration that ends before the first scan: the run would report that it never started. All
/// readers guarantee at least one scan.
void check_scans(const LoadedScenario& loaded, const RangeRecording& recording) {
  const double duration_s = loaded.scenario.run.duration_s,
               first = recording.scans.front().t - start_time(recording);
  if (first <= duration_s) return;
  throw InputError(
      fmt::format("{}: run.duration_s = {}: the first scan of this recording comes {:.1f} s after its start",
                  loaded.source_of("run.duration_s"), duration_s, first));
}

/// Identities of the anchors, found by position among the surveyed landmarks; nullopt if one is missing.
std::optional<std::vector<std::int64_t>> identities_of_anchors(const std::vector<Eigen::Vector2d>& anchors,
                                                               const RangeRecording& recording) {
  constexpr double same_place_m = 0.05;
  std::vector<std::int64_t> identities;
  for (const Eigen::Vector2d& anchor : anchors) {
    const auto surveyed = std::find_if(
        recording.landmarks.begin(), recording.landmarks.end(),
        [&](const auto& landmark) { return (landmark.position - anchor).norm() <= same_place_m; });
    if (surveyed == recording.landmarks.end()) return std::nullopt;
    identities.push_back(surveyed->identity);
  }
  return identities;
}

/// Reports what parts of a recording the run does not use, with counts.
std::vector<std::string> left_out(const RangeRecording& recording, const PlanarSlamSettings& s) {
  std::size_t all = 0, far = 0, without_identity = 0, placed = 0;
  for (const RangeRecording::Scan& scan : recording.scans) {
    placed += true_position(recording, scan.t).has_value();
    for (const Detection& d : scan.detections) {
      ++all;
      far += d.range_m > s.sensor.max_range_m;
      without_identity += d.identity == Detection::unknown;
    }
  }
  std::vector<std::string> notes;
  if (far > 0)
    notes.push_back(fmt::format("{} of {} detections are beyond sensor.max_range_m = {} and left out", far,
                                all, s.sensor.max_range_m));
  if (without_identity > 0 && s.association.method == DataAssociationSettings::Method::known)
    notes.push_back(fmt::format("{} of {} detections do not say which landmark they are of and are left out",
                                without_identity, all));
  if (!recording.truth.empty() && placed < recording.scans.size())
    notes.push_back(
        fmt::format("the truth is known at {} of {} scans: between two true places at most half a second "
                    "apart",
                    placed, recording.scans.size()));
  return notes;
}

/// Commands have no effect on a recording.
LoopParts replay_of(const SharedRangeRecordings& recordings, const RangeSensorSettings& sensor,
                    std::unique_ptr<Estimator> estimator, double duration_s) {
  const bool whole_us = recordings->front().whole_us;
  return {std::make_unique<ReplayClock>(scan_times(*recordings, duration_s), whole_us),
          std::make_unique<ReplayWorld>(recorded_truths(recordings)),
          std::make_unique<SensorSet>(recorded_ranges(recordings, sensor)),
          std::move(estimator),
          std::make_unique<NoDecision>(),
          std::make_unique<SteeringController>()};
}

}  // namespace

Survey survey_of(const RangeRecording& recording, bool identified) {
  Survey survey;
  survey.identified = identified;
  for (const RangeRecording::Landmark& landmark : recording.landmarks)
    survey.landmarks.push_back({landmark.identity, {landmark.position.x(), landmark.position.y(), 0}});
  return survey;
}

Assembly assemble_ranges(RangeRecording recording, const PlanarSlamSettings& s, double duration_s) {
  const auto recordings = std::make_shared<const std::vector<RangeRecording>>(1, std::move(recording));
  const RangeRecording& r = recordings->front();
  RangeSensorSettings sensor;
  sensor.max_range_m = s.sensor.max_range_m;
  sensor.fixes = s.filter.use_fixes ? Fixes::all : s.start.at_first_fix ? Fixes::first : Fixes::none;
  const auto identities = identities_of_anchors(s.filter.anchors, r);
  const bool frame_is_fixed = s.filter.use_fixes || !s.filter.anchors.empty();
  Assembly out;
  out.parts = replay_of(
      recordings, sensor,
      std::make_unique<SlamEstimator>(single_vehicle(s, identities.value_or(std::vector<std::int64_t>{}))),
      duration_s);
  out.info.body = "vehicle";
  out.info.rate_hz = mean_rate_hz(scan_times(*recordings, duration_s));
  out.info.ate_alignment = frame_is_fixed ? "none" : "se3";
  out.info.truth_recorded = !r.truth.empty();
  out.info.warnings = clock_warnings(r);
  out.info.survey = survey_of(r, s.association.method == DataAssociationSettings::Method::known);
  out.notes = r.notes;
  for (std::string& note : left_out(r, s)) out.notes.push_back(std::move(note));
  if (!frame_is_fixed)
    out.notes.emplace_back(
        "no anchors: position and heading are unobservable, the map is relative to the start of the vehicle");
  out.anchors = static_cast<int>(s.filter.anchors.size());
  out.recordings = recordings;
  return out;
}

namespace {

Assembly assemble_vehicle(const LoadedScenario& loaded) {
  RangeRecording recording = with_rounded_stamps(read_range_recording(loaded));
  PlanarSlamSettings settings = loaded.scenario.planar;
  settings.entropy = loaded.scenario.run.entropy;
  check_vehicle(loaded, recording);
  check_identities(loaded, recording);
  check_fixes(loaded, recording);
  check_scans(loaded, recording);
  if (settings.association.method == DataAssociationSettings::Method::known &&
      !identities_of_anchors(settings.filter.anchors, recording))
    throw InputError(
        fmt::format("{}: estimator.anchors_m: with association.method = known each anchor must be "
                    "one of the recording's surveyed landmarks (landmarks.csv), within 5 cm: the sensor "
                    "tells them by their identity",
                    loaded.source_of("estimator.anchors_m")));
  Assembly out = assemble_ranges(std::move(recording), settings, loaded.scenario.run.duration_s);
  put_scenario(loaded, out.info);
  return out;
}

/// The bodies with each robot starting at its motion-capture pose at time t.
EstimatorSettings recorded_team(const LoadedScenario& loaded, const std::vector<RangeRecording>& robots,
                                double t) {
  const Scenario& s = loaded.scenario;
  EstimatorSettings team;
  team.filter = filter_of(s);
  team.health = s.planar.health;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto reference = true_position(robots[i], t);
    if (!reference || !reference->heading_rad)
      throw InputError(
          fmt::format("{}: recording.folder: where robot {} starts is not known: its ground truth is "
                      "wanted at t = {:.3f} s",
                      loaded.source_of("recording.folder"), i + 1, t));
    Scenario at_start = s;
    at_start.team_start.positions_m = {{reference->position.x(), reference->position.y(), 0}};
    at_start.team_start.headings_rad = {*reference->heading_rad};
    team.bodies.push_back(member_of(at_start, 0, {}));
  }
  return team;
}

Assembly assemble_team(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  std::vector<RangeRecording> read = read_team_recording(loaded);
  for (RangeRecording& robot : read) robot = with_rounded_stamps(std::move(robot));
  const auto robots = std::make_shared<const std::vector<RangeRecording>>(std::move(read));
  const std::vector<double> times = scan_times(*robots, s.run.duration_s);
  if (times.empty())
    throw InputError(fmt::format("{}: run.duration_s = {}: nothing was seen by then",
                                 loaded.source_of("run.duration_s"), s.run.duration_s));
  Assembly out;
  out.parts = replay_of(
      robots, RangeSensorSettings{s.planar.sensor.max_range_m, Fixes::none, s.sensor.measures_vehicles},
      point_estimator(loaded, recorded_team(loaded, *robots, times.front())), s.run.duration_s);
  put_scenario(loaded, out.info);
  out.info.body = "vehicle";
  out.info.rate_hz = mean_rate_hz(times);
  out.info.bodies = static_cast<int>(robots->size());
  out.info.inputs = input_names(s.motion());
  out.info.survey = survey_of(robots->front(), true);
  for (std::size_t i = 0; i < robots->size(); ++i) {
    const RangeRecording& robot = (*robots)[i];
    out.notes.insert(out.notes.end(), robot.notes.begin(), robot.notes.end());
    for (const std::string& warning : clock_warnings(robot))
      out.info.warnings.push_back(fmt::format("robot {}: {}", i + 1, warning));
  }
  out.recordings = robots;
  return out;
}

}  // namespace

Assembly assemble_recorded_ranges(const LoadedScenario& loaded) {
  return loaded.scenario.recording.team ? assemble_team(loaded) : assemble_vehicle(loaded);
}

}  // namespace incognita
