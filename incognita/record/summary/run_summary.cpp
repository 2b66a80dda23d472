#include "incognita/record/summary/run_summary.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "incognita/math/unknown.hpp"
#include "incognita/record/files/quantile.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_text_bytes = 1000;  // per string: the document must fit PaddedFile
constexpr std::size_t max_warnings = 5;
constexpr std::size_t max_names = 50;
constexpr std::size_t max_vehicles = 40;  // the others are in vehicles.csv

constexpr const char* reserved[] = {"status",         "reason",
                                    "frames",         "landmarks",
                                    "lost_frames",    "entropy",
                                    "mean_nis",       "ate_m",
                                    "ate_alignment",  "mean_nees",
                                    "timing_ms",      "seed",
                                    "version",        "anchors",
                                    "decisions",      "warnings",
                                    "tracked_frames", "overconfident_frames",
                                    "exploration",    "observability",
                                    "vehicles",       "degraded_frames",
                                    "path_m",         "drift_percent",
                                    "map_error_m",    "map_error_landmarks",
                                    "consistency",    "compared_poses",
                                    "ate_adjusted_m"};

std::string short_text(const std::string& text) {
  return text.size() <= max_text_bytes ? text : text.substr(0, max_text_bytes) + "...";
}

Json json_of(const SummaryValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return short_text(*text);
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json timing_json(const std::vector<std::pair<std::string, std::vector<double>>>& stage_ms) {
  Json timing = Json::object();
  for (const auto& [stage, ms] : stage_ms)
    timing[stage] = {{"median", quantile(ms, 0.5)}, {"p99", quantile(ms, 0.99)}};
  return timing;
}

Json quantity_json(const QuantityReport& q) {
  Json json{{"name", q.name},
            {"unit", q.unit},
            {"ideally_observable", q.ideally_observable},
            {"gained", q.gained},
            {"by_motion_model", q.by_motion_model},
            {"estimated_sigma", nullptr},
            {"sigma_from_measurements", nullptr}};
  if (q.estimated_sigma) json["estimated_sigma"] = *q.estimated_sigma;
  if (q.sigma_from_measurements) json["sigma_from_measurements"] = *q.sigma_from_measurements;
  return json;
}

Json observability_json(const ObservabilityReport& report) {
  Json json{{"followed", report.uncovered.empty()},
            {"why_not", short_text(report.uncovered)},
            {"anchors", report.anchors},
            {"position_fixes", report.position_fixes},
            {"ideal_nullity", report.ideal_nullity},
            {"directions", Json::array()}};
  for (const QuantityReport& q : report.quantities) json["directions"].push_back(quantity_json(q));
  if (!report.uncovered.empty()) return json;
  const InformationRank& information = report.information;
  json["errors"] = information.errors;
  json["ideal_rank"] = information.errors - report.ideal_nullity;
  json["rank"] = information.rank;
  json["nullity"] = information.nullity();
  json["gap"] = information.gap();
  json["ambiguous"] = information.ambiguous;
  json["spurious_information"] = report.spurious_information;
  json["by_motion_model"] = report.by_motion_model;
  json["without_information"] = Json::array();
  for (std::size_t i = 0; i < std::min(report.without_information.size(), max_names); ++i)
    json["without_information"].push_back(report.without_information[i]);
  json["without_information_count"] = report.without_information.size();
  return json;
}

Json band_json(const std::optional<MeanNormalizedSquare>& value) {
  if (!value) return nullptr;
  return {value->band.low, value->band.high};
}

Json mean_json(const std::optional<MeanNormalizedSquare>& value) {
  return value ? Json(value->mean) : Json(nullptr);
}

Json pose_json(const PoseConsistency& pose) {
  return {{"verdict", name(pose.verdict())},
          {"nees_band", band_json(pose.nees)},
          {"overconfident_frames", pose.overconfident_frames},
          {"frames_with_truth", pose.frames_with_truth}};
}

Json consistency_json(const ConsistencyReport& report) {
  return {{"verdict", name(report.verdict)},
          {"nis", mean_json(report.nis)},
          {"nis_band", band_json(report.nis)},
          {"outlier_share", report.outlier_share ? Json(*report.outlier_share) : Json(nullptr)},
          {"nees", mean_json(report.pose.nees)},
          {"nees_band", band_json(report.pose.nees)},
          {"overconfident_frames", report.pose.overconfident_frames},
          {"frames_with_truth", report.pose.frames_with_truth},
          {"symptom", report.symptom},
          {"causes", report.causes}};
}

double ate_m(const MatchedTrajectories& matched, const std::optional<Alignment>& alignment) {
  if (!alignment || matched.estimate.empty()) return unknown;
  return absolute_trajectory_error({aligned(matched.estimate, *alignment), matched.truth}).rmse;
}

/// Length of the true path, else of the estimated one if it is in m.
double path_json(const BodyReport& body, const RunReport& report) {
  return report.true_path || report.scale_known ? body.path_length : unknown;
}

}  // namespace

RunSummary::RunSummary(const RunInfo& info)
    : version_(info.version),
      seed_(info.seed),
      in_room_(info.room.has_value()),
      outcome_(same_frame_as_truth(info)),
      consistency_(same_frame_as_truth(info)),
      survey_(info.survey),
      warnings_(info.warnings),
      distances_(info.body == "camera", info.steered_m) {
  const auto kind = alignment_kind(info.ate_alignment);
  if (!kind)
    throw std::invalid_argument("ate_alignment is `" + info.ate_alignment +
                                "`, must be none, se3, sim3 or yaw");
  alignment_ = *kind;
  entropy_ = {unknown, unknown, unknown};
  for (const auto& [key, value] : info.extra) note(key, value);
}

void RunSummary::note(const std::string& key, SummaryValue value) {
  if (std::find(std::begin(reserved), std::end(reserved), key) != std::end(reserved))
    throw std::invalid_argument("summary.json reserves the key `" + key + "`");
  for (auto& [name, old] : extra_)
    if (name == key) {
      old = std::move(value);
      return;
    }
  extra_.emplace_back(key, std::move(value));
}

void RunSummary::add(const Snapshot& snapshot) {
  if (frames_ == 0) first_t_s_ = snapshot.tick.t;
  last_t_s_ = snapshot.tick.t;
  ++frames_;
  const TrackingState state = snapshot.status.state;
  if (state != TrackingState::starting && state != TrackingState::lost) ++tracked_frames_;
  if (state == TrackingState::degraded) ++degraded_frames_;
  if (state == TrackingState::lost) ++lost_frames_;
  for (const SnapshotBody& body : snapshot.bodies) decisions_ += body.decision.decided;
  exploration_.add(snapshot);
  outcome_.add(snapshot);
  landmarks_ = mapped_landmarks(snapshot);
  anchors_ = static_cast<int>(snapshot.landmarks.size()) - landmarks_;
  // Keeps the last known entropy in frames without one, e.g. without a pose.
  if (std::isfinite(snapshot.entropy.total)) entropy_ = snapshot.entropy;
  consistency_.add(snapshot);
  paths_.add(snapshot);
  adjusted_.add(snapshot);
  if (!survey_.landmarks.empty()) map_ = snapshot.landmarks;
  compare_with_truth(snapshot);
  if (alignment_ == AlignmentKind::none) distances_.add(snapshot);
  for (const auto& [stage, ms] : snapshot.timing_ms) {
    auto found = std::find_if(stage_ms_.begin(), stage_ms_.end(),
                              [&stage = stage](const auto& s) { return s.first == stage; });
    if (found == stage_ms_.end()) found = stage_ms_.insert(found, {stage, {}});
    found->second.push_back(ms);
  }
}

void RunSummary::compare_with_truth(const Snapshot& s) {
  matched_.resize(std::max(matched_.size(), s.bodies.size()));
  for (const SnapshotBody& body : s.bodies) {
    if (!body.truth) continue;
    has_truth_ = true;
    if (!has_pose(body)) continue;
    MatchedTrajectories& own = matched_[static_cast<std::size_t>(&body - s.bodies.data())];
    own.truth.push_back(*body.truth);
    own.estimate.push_back(body.estimate);
  }
}

MatchedTrajectories RunSummary::all_matched() const {
  MatchedTrajectories all;
  for (const MatchedTrajectories& body : matched_) {
    all.truth.insert(all.truth.end(), body.truth.begin(), body.truth.end());
    all.estimate.insert(all.estimate.end(), body.estimate.begin(), body.estimate.end());
  }
  return all;
}

RunReport RunSummary::report(RunStatus status, const std::string& reason) const {
  RunReport r;
  r.status = status;
  r.reason = reason;
  r.duration_s = last_t_s_ - first_t_s_;
  r.frames = frames_;
  r.tracked_frames = tracked_frames_;
  r.degraded_frames = degraded_frames_;
  r.lost_frames = lost_frames_;
  r.alignment = alignment_;
  r.scale_known = alignment_ != AlignmentKind::sim3;
  r.landmarks = landmarks_;
  r.anchors = anchors_;
  r.consistency = consistency_.report();
  r.decisions = decisions_;
  r.warnings = warnings_;
  report_paths(r);
  report_map(r);
  return r;
}

/// Rms over the same poses as `ate_m`; NaN without adjusted keyframes.
double RunSummary::ate_adjusted_m() const {
  if (matched_.size() != 1) return unknown;
  MatchedTrajectories matched{{}, matched_[0].truth};
  auto next = matched_[0].estimate.begin();
  for (const StampedPose& pose : adjusted_.trajectory()) {
    if (next == matched_[0].estimate.end() || pose.t != next->t) continue;
    matched.estimate.push_back(pose);
    ++next;
  }
  if (matched.estimate.size() != matched.truth.size()) return unknown;
  return ate_m(matched, align(matched, alignment_));
}

void RunSummary::report_paths(RunReport& r) const {
  const MatchedTrajectories all = all_matched();
  const auto alignment = align(all, alignment_);
  const std::vector<BodyPath>& paths = paths_.bodies();
  r.truth_known = has_truth_;
  r.true_path = has_truth_ && std::all_of(paths.begin(), paths.end(), [](const BodyPath& path) {
                  return path.true_length_m && !path.truth_has_gaps;
                });
  if (!paths.empty()) r.body.path_length = 0;
  r.body.ate_m = ate_m(all, alignment);
  r.ate_adjusted_m = ate_adjusted_m();
  r.body.compared_frames = paths.size() > 1 ? tracked_frames_ : std::ssize(all.estimate);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    BodyReport body;
    body.path_length = r.true_path ? *paths[i].true_length_m : paths[i].estimated_length;
    if (paths[i].truth && alignment && r.true_path && body.path_length > 0) {
      const StampedPose last = aligned({*paths[i].estimate}, *alignment).front();
      body.drift_percent = 100 * (last.position - paths[i].truth->position).norm() / body.path_length;
    }
    r.body.path_length += body.path_length;
    if (paths.size() == 1) r.body.drift_percent = body.drift_percent;
    if (i < matched_.size()) {
      body.ate_m = ate_m(matched_[i], alignment);
      body.compared_frames = std::ssize(matched_[i].estimate);
    }
    if (i < r.consistency.bodies.size()) body.consistency = r.consistency.bodies[i];
    r.bodies.push_back(body);
  }
}

std::optional<Alignment> RunSummary::truth_from_map() const {
  if (alignment_ == AlignmentKind::none) return Alignment{};
  // Without a true trajectory, the map is aligned to the survey itself.
  const MatchedTrajectories all = all_matched();
  return all.truth.empty() ? align_to_survey(map_, survey_, alignment_) : align(all, alignment_);
}

void RunSummary::report_map(RunReport& r) const {
  r.entropy = entropy_.total;
  r.entropy_extended = exploration_.entropy_extended();
  r.outcome = outcome_.measures();
  r.in_room = in_room_;
  r.surveyed = static_cast<int>(survey_.landmarks.size());
  if (r.surveyed == 0) {
    r.map_error_m = r.outcome.map_rms_m.value_or(unknown);
    r.map_error_landmarks = r.outcome.landmarks;
    return;
  }
  const auto alignment = truth_from_map();
  if (!alignment) return;
  const SurveyedMapError error = surveyed_map_error(map_, survey_, *alignment);
  r.map_error_m = error.rms_m;
  r.map_error_landmarks = error.matched;
}

std::vector<SurveyedLandmark> RunSummary::survey_on_map() const {
  if (survey_.landmarks.empty()) return {};
  const auto a = truth_from_map();
  if (!a) return {};
  std::vector<SurveyedLandmark> out = survey_.landmarks;
  for (SurveyedLandmark& landmark : out)
    landmark.position = a->rotation.transpose() * (landmark.position - a->translation) / a->scale;
  return out;
}

std::string RunSummary::json(RunStatus status, const std::string& reason) const {
  const RunReport report = this->report(status, reason);
  Json json{{"status", name(status)},
            {"reason", short_text(reason)},
            {"version", version_},
            {"seed", seed_},
            {"frames", frames_},
            {"tracked_frames", tracked_frames_},
            {"degraded_frames", degraded_frames_},
            {"lost_frames", lost_frames_},
            {"landmarks", landmarks_},
            {"anchors", anchors_},
            {"decisions", decisions_},
            {"entropy", {{"vehicle", entropy_.vehicle}, {"map", entropy_.map}, {"total", entropy_.total}}},
            {"mean_nis", consistency_.mean_nis()},
            {"path_m", path_json(report.body, report)}};
  if (has_truth_) {
    json["compared_poses"] = all_matched().estimate.size();
    json["ate_m"] = report.body.ate_m;
    if (std::isfinite(report.ate_adjusted_m)) json["ate_adjusted_m"] = report.ate_adjusted_m;
    json["ate_alignment"] = name(alignment_);
    json["drift_percent"] = report.body.drift_percent;
    json["mean_nees"] = consistency_.mean_nees();
    json["overconfident_frames"] = alignment_ == AlignmentKind::none
                                       ? Json(report.consistency.pose.overconfident_frames)
                                       : Json(nullptr);
  }
  if (report.surveyed > 0 || report.outcome.mapped) {
    json["map_error_m"] = report.map_error_m;
    json["map_error_landmarks"] = report.map_error_landmarks;
  }
  json["consistency"] = consistency_json(report.consistency);
  const auto or_null = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  constexpr int thesis_landmarks = 14;  // the number whose time and entropy Section 6.3.1 reports
  const OutcomeMeasures& outcome = report.outcome;
  json["exploration"] = {{"located", exploration_.located()},
                         {"t_14_located_s", or_null(exploration_.located_t_s(thesis_landmarks))},
                         {"coverage", or_null(exploration_.coverage())},
                         {"entropy_extended", or_null(exploration_.entropy_extended())},
                         {"mapped", or_null(outcome.mapped)},
                         {"mapped_60_s", or_null(outcome.mapped_60_s)},
                         {"t_90_mapped_s", or_null(outcome.t_90_mapped_s)},
                         {"within_5_cm", or_null(outcome.within_5_cm)},
                         {"within_3_sigma", or_null(outcome.within_3_sigma)},
                         {"lost", int{outcome.lost}},
                         {"diverged", outcome.diverged ? Json(int{*outcome.diverged}) : Json(nullptr)}};
  Json& vehicles = json["vehicles"] = Json::array();
  const std::vector<PathDistance> distances = distances_.bodies(report.bodies.size());
  for (std::size_t i = 0; i < std::min(report.bodies.size(), max_vehicles); ++i) {
    const BodyReport& body = report.bodies[i];
    const PathDistance& distance = distances[i];
    vehicles.push_back({{"compared_frames", body.compared_frames},
                        {"ate_m", body.ate_m},
                        {"mean_nees", consistency_.mean_nees(i)},
                        {"consistency", pose_json(body.consistency)},
                        {"from_path_m", {{"median", distance.median_m}, {"p95", distance.p95_m}}}});
  }
  if (observability_) json["observability"] = observability_json(*observability_);
  json["timing_ms"] = timing_json(stage_ms_);
  json["warnings"] = Json::array();
  for (std::size_t i = 0; i < std::min(warnings_.size(), max_warnings); ++i)
    json["warnings"].push_back(short_text(warnings_[i]));
  for (const auto& [key, value] : extra_) json[key] = json_of(value);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace incognita
