#include "incognita/record/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "incognita/record/quantile.hpp"
#include "incognita/record/series.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_text_bytes = 1000;  // of one string: the document has to fit its place on the disk
constexpr std::size_t max_warnings = 5;
constexpr std::size_t max_names = 50;
constexpr std::size_t max_vehicles = 40;  // the others are in vehicles.csv

constexpr const char* reserved[] = {"status",        "reason",         "frames",
                                    "landmarks",     "lost_frames",    "entropy",
                                    "mean_nis",      "ate_m",          "ate_alignment",
                                    "mean_nees",     "timing_ms",      "seed",
                                    "version",       "anchors",        "decisions",
                                    "warnings",      "tracked_frames", "overconfident_frames",
                                    "exploration",   "observability",  "vehicles",
                                    "compared_poses"};

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
            {"believed_sigma", nullptr},
            {"sigma_from_looks", nullptr}};
  if (q.believed_sigma) json["believed_sigma"] = *q.believed_sigma;
  if (q.sigma_from_looks) json["sigma_from_looks"] = *q.sigma_from_looks;
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
  json["wrongly_believed"] = report.wrongly_believed;
  json["by_motion_model"] = report.by_motion_model;
  json["without_information"] = Json::array();
  for (std::size_t i = 0; i < std::min(report.without_information.size(), max_names); ++i)
    json["without_information"].push_back(report.without_information[i]);
  json["without_information_count"] = report.without_information.size();
  return json;
}

}  // namespace

const char* name(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

bool same_frame_as_truth(const RunInfo& info) { return info.ate_alignment == name(AlignmentKind::none); }

RunSummary::RunSummary(const RunInfo& info)
    : version_(info.version), seed_(info.seed), team_(info.body == "camera", info.steered_m) {
  const auto kind = alignment_kind(info.ate_alignment);
  if (!kind)
    throw std::invalid_argument("ate_alignment `" + info.ate_alignment + "`; none, se3, sim3 or yaw");
  alignment_ = *kind;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  entropy_ = {unknown, unknown, unknown};
  for (const auto& [key, value] : info.extra) note(key, value);
}

void RunSummary::note(const std::string& key, SummaryValue value) {
  if (std::find(std::begin(reserved), std::end(reserved), key) != std::end(reserved))
    throw std::invalid_argument("summary.json has its own `" + key + "`");
  for (auto& [name, old] : extra_)
    if (name == key) {
      old = std::move(value);
      return;
    }
  extra_.emplace_back(key, std::move(value));
}

void RunSummary::add(const Snapshot& snapshot) {
  ++frames_;
  if (has_pose(snapshot)) ++tracked_frames_;
  if (snapshot.status.state == TrackingState::lost) ++lost_frames_;
  if (snapshot.advice.decided) ++decisions_;
  exploration_.add(snapshot);
  landmarks_ = mapped_landmarks(snapshot);
  anchors_ = static_cast<int>(snapshot.landmarks.size()) - landmarks_;
  // where an entropy is not known, as in a frame without a pose, the last one known stands
  if (std::isfinite(snapshot.entropy.total)) entropy_ = snapshot.entropy;
  if (snapshot.nis_dof > 0) nis_per_dof_.add(snapshot.nis / snapshot.nis_dof);
  compare_with_truth(snapshot);
  if (has_pose(snapshot)) team_.add(snapshot);
  for (const auto& [stage, ms] : snapshot.timing_ms) {
    auto found =
        std::find_if(stage_ms_.begin(), stage_ms_.end(), [&](const auto& s) { return s.first == stage; });
    if (found == stage_ms_.end()) found = stage_ms_.insert(found, {stage, {}});
    found->second.push_back(ms);
  }
}

void RunSummary::compare(const StampedPose& truth, const StampedPose& estimate, const PoseCovariance& P,
                         TrackingState state) {
  matched_.truth.push_back(truth);
  matched_.estimate.push_back(estimate);
  if (alignment_ != AlignmentKind::none) return;  // a covariance speaks of the frame it is in
  const PoseError error = pose_error(truth, estimate);
  if (const auto nees = pose_nees(error, P)) nees_per_dof_.add(*nees);
  if (state == TrackingState::tracking && beyond_three_sigma(error.head<3>(), P.topLeftCorner<3, 3>()))
    ++overconfident_frames_;
}

std::string RunSummary::in_words() const {
  const double error_m = has_truth_ ? ate_m() : std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(error_m)) return "";
  std::string words = fmt::format("position off by {:.3g} m rms", error_m);
  if (alignment_ != AlignmentKind::none) words += fmt::format(" after a fit ({})", name(alignment_));
  const double nees = nees_per_dof_.value();
  if (std::isfinite(nees)) words += fmt::format(", NEES {:.3g}", nees);
  if (std::isfinite(nis_per_dof_.value())) words += fmt::format(", NIS {:.3g}", nis_per_dof_.value());
  constexpr double far_too_sure = 10;  // three times as far off as its sigmas say
  if (nees > far_too_sure) words += ": far surer of itself than it may be";
  return words + where_truth_was_known();
}

std::string RunSummary::where_truth_was_known() const {
  if (!team_.empty()) return "\n" + team_.in_words(tracked_frames_);
  const auto compared = static_cast<std::int64_t>(matched_.estimate.size());
  if (compared == tracked_frames_) return "";
  return fmt::format("; truth at {} of {} tracked frames", compared, tracked_frames_);
}

void RunSummary::compare_with_truth(const Snapshot& s) {
  has_truth_ = has_truth_ || s.truth ||
               std::any_of(s.vehicles.begin(), s.vehicles.end(), [](const auto& v) { return v.truth; });
  if (!has_pose(s)) return;
  if (s.truth) compare(true_pose(s.tick, *s.truth), estimated_pose(s), pose_covariance(s), s.status.state);
  for (std::size_t i = 1; i < s.vehicles.size(); ++i)
    if (s.vehicles[i].truth)
      compare(*s.vehicles[i].truth, s.vehicles[i].estimate, s.vehicles[i].covariance, s.status.state);
}

double RunSummary::ate_m() const {
  const auto alignment = align(matched_, alignment_);
  if (!alignment || matched_.estimate.empty()) return std::numeric_limits<double>::quiet_NaN();
  return absolute_trajectory_error({aligned(matched_.estimate, *alignment), matched_.truth}).rmse;
}

std::string RunSummary::json(RunStatus status, const std::string& reason) const {
  Json json{{"status", name(status)},
            {"reason", short_text(reason)},
            {"version", version_},
            {"seed", seed_},
            {"frames", frames_},
            {"tracked_frames", tracked_frames_},
            {"lost_frames", lost_frames_},
            {"landmarks", landmarks_},
            {"anchors", anchors_},
            {"decisions", decisions_},
            {"entropy", {{"vehicle", entropy_.vehicle}, {"map", entropy_.map}, {"total", entropy_.total}}},
            {"mean_nis", nis_per_dof_.value()}};
  if (has_truth_) {
    json["compared_poses"] = matched_.estimate.size();
    json["ate_m"] = ate_m();
    json["ate_alignment"] = name(alignment_);
    json["mean_nees"] = nees_per_dof_.value();
    json["overconfident_frames"] =
        alignment_ == AlignmentKind::none ? Json(overconfident_frames_) : Json(nullptr);
  }
  const auto told = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  constexpr int thesis_landmarks = 14;  // whose time and entropy Section 6.3.1 tells
  json["exploration"] = {{"located", exploration_.located()},
                         {"t_14_located_s", told(exploration_.located_t_s(thesis_landmarks))},
                         {"coverage", told(exploration_.coverage())},
                         {"entropy_extended", told(exploration_.entropy_extended())}};
  if (!team_.empty()) {
    Json& vehicles = json["vehicles"] = Json::array();
    const std::vector<TeamSummary::Vehicle> all = team_.vehicles();
    for (std::size_t i = 0; i < std::min(all.size(), max_vehicles); ++i) {
      const TeamSummary::Vehicle& v = all[i];
      vehicles.push_back({{"compared_frames", v.compared_frames},
                          {"ate_m", v.ate_m},
                          {"mean_nees", v.mean_nees},
                          {"from_path_m", {{"median", v.from_path_median_m}, {"p95", v.from_path_p95_m}}}});
    }
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
