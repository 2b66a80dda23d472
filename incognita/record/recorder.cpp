#include "incognita/record/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "incognita/math/unknown.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/mat_file.hpp"
#include "incognita/record/files/number.hpp"
#include "incognita/record/map_files.hpp"
#include "incognita/record/snapshot/interventions.hpp"
#include "incognita/record/snapshot/pose_rows.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

constexpr const char* cut_short = "the program ended before the run did";
constexpr const char* matches_header =
    "t,body,sensor,id,kind,predicted_1,predicted_2,sigma_1,sigma_2,measured_1,measured_2,correlation,outcome";
/// Bodies and sensors are counted from 1 in files.
std::string match_row(double t, const SnapshotMatch& match) {
  std::string row;
  append_number(row, t);
  row += fmt::format(",{},{}-{},{},{}", match.body + 1, match.image ? "camera" : "sensor", match.sensor + 1,
                     match.of_body ? match.id + 1 : match.id, kind(match));
  const Eigen::Vector2d sigma = match.innovation_cov.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::Vector2d measured = match.measured.value_or(Eigen::Vector2d(unknown, unknown));
  for (const double value :
       {match.predicted.x(), match.predicted.y(), sigma.x(), sigma.y(), measured.x(), measured.y()})
    append_cell(row, value);
  append_cell(row, match.image ? match.correlation : unknown);
  append_cell(row, name(match.outcome));
  return row;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& directory, const RunInfo& info)
    : info_(info), compare_with_truth_(same_frame_as_truth(info)), summary_(info), directory_(directory) {
  try {
    open_files(info);
  } catch (...) {
    directory_.discard();
    throw;
  }
}

void Recorder::open_files(const RunInfo& info) {
  summary_file_.emplace(directory_.file("summary.json"), summary_.json(RunStatus::interrupted, cut_short));
  write_whole_file(directory_.file("effective.toml"), info.effective_toml);
  estimate_ = RowFile(directory_.file("estimate.tum"), tum_header(info.body));
  covariance_ = RowFile(directory_.file("covariance.csv"), covariance_header());
  matches_ = RowFile(directory_.file("measurements.csv"), matches_header);
  timings_ = TimingTable(directory_.file("timings.csv"));
  bodies_.emplace(directory_, info);
  log_.emplace(directory_.file("run.mcap"), info);
}

void Recorder::publish(const Snapshot& snapshot) {
  summary_.add(snapshot);
  map_ = snapshot.landmarks;
  write_pose(snapshot);
  write_series(snapshot);
  write_matches(snapshot);
  log(snapshot.tick, snapshot.interventions);
  bodies_->publish(snapshot);
  timings_.add(snapshot);
  log_->publish(snapshot);
  refresh_summary(snapshot.tick.t);
}

void Recorder::write_pose(const Snapshot& snapshot) {
  const double t = snapshot.tick.t;
  if (snapshot.bodies.empty()) return;
  const SnapshotBody& body = snapshot.bodies.front();
  if (body.truth) {
    if (!truth_opened_)
      truth_ = RowFile(directory_.file("truth.tum"), tum_header(info_.body, body.truth->oriented));
    truth_opened_ = true;
    truth_.append(tum_row(*body.truth), t);
  }
  if (!has_pose(body)) return;
  estimate_.append(tum_row(body.estimate), t);
  covariance_.append(covariance_row(t, body.covariance), t);
}

void Recorder::open_series() {
  std::string header = "t,state";
  const auto columns = series_columns(*with_errors_);
  for (const std::string& column : columns) append_cell(header, column);
  series_ = RowFile(directory_.file("series.csv"), header);
  series_columns_.resize(columns.size() + 2);
}

void Recorder::write_series(const Snapshot& snapshot) {
  if (!with_errors_) {
    const bool truth_known = !snapshot.bodies.empty() && snapshot.bodies.front().truth;
    with_errors_ = compare_with_truth_ && (info_.truth_recorded || truth_known);
    open_series();
  }
  const std::vector<double> values = series_row(snapshot, *with_errors_);
  std::string row;
  append_number(row, snapshot.tick.t);
  append_cell(row, name(snapshot.status.state));
  for (const double value : values) append_cell(row, value);
  series_columns_[0].push_back(snapshot.tick.t);
  series_columns_[1].push_back(static_cast<double>(snapshot.status.state));
  for (std::size_t i = 0; i < values.size(); ++i) series_columns_[i + 2].push_back(values[i]);
  series_.append(row, snapshot.tick.t);
}

void Recorder::write_matches(const Snapshot& snapshot) {
  for (const SnapshotMatch& match : snapshot.matches)
    matches_.append(match_row(snapshot.tick.t, match), snapshot.tick.t);
}

void Recorder::log(const Tick& tick, const std::vector<Intervention>& interventions) {
  if (interventions.empty()) return;
  if (!interventions_.is_open()) interventions_ = RowFile(directory_.file("interventions.jsonl"), "");
  for (const Intervention& intervention : interventions)
    interventions_.append(log_row(tick.frame, tick.t, intervention), tick.t);
}

void Recorder::refresh_summary(double t_s) {
  if (!first_t_s_) first_t_s_ = t_s;
  if (!summary_t_s_) summary_t_s_ = t_s;
  // A summary costs time proportional to the length of the run, so its interval grows with that length.
  if (t_s - *summary_t_s_ < std::max(1.0, 0.02 * (t_s - *first_t_s_))) return;
  summary_t_s_ = t_s;
  summary_file_->overwrite(summary_.json(RunStatus::interrupted, cut_short));
}

void Recorder::write_series_mat() const {
  MatFile mat;
  const auto names = series_columns(with_errors_.value_or(false));
  for (std::size_t i = 0; i < series_columns_.size(); ++i)
    mat.columns.emplace_back(i == 0 ? "t" : i == 1 ? "state" : names[i - 2], series_columns_[i]);
  for (std::size_t i = 0; i < timings_.stages().size(); ++i)
    mat.columns.emplace_back("timing_ms_" + timings_.stages()[i], timings_.column(i));
  for (const TrackingState state : {TrackingState::starting, TrackingState::tracking, TrackingState::degraded,
                                    TrackingState::lost, TrackingState::relocated}) {
    if (mat.words.empty()) mat.words.emplace_back("state_names", std::vector<std::string>{});
    mat.words.front().second.emplace_back(name(state));  // state 0 is the first name
  }
  write_mat(directory_.file("series.mat"), mat);
}

void Recorder::write_adjusted() const {
  const Trajectory adjusted = summary_.adjusted_trajectory();
  if (adjusted.empty()) return;
  RowFile file(directory_.file("adjusted.tum"), tum_header(info_.body));
  for (const StampedPose& pose : adjusted) file.append(tum_row(pose), pose.t);
  file.close();
}

RunOutcome Recorder::finish(RunStatus status, const std::string& reason, const Finishing& finishing) {
  std::vector<std::string> failures;
  const auto attempt = [&](const auto& step) {
    try {
      step();
    } catch (const std::exception& error) {
      failures.emplace_back(error.what());
    }
  };
  attempt([&] {
    if (!with_errors_) {
      with_errors_ = false;
      open_series();
    }
  });
  for (RowFile* file : {&estimate_, &truth_, &covariance_, &series_, &matches_, &interventions_})
    attempt([&] { file->close(); });
  attempt([&] {
    if (bodies_) bodies_->close();
  });
  attempt([&] { timings_.close(); });
  attempt([&] { log_->close(map_); });
  attempt([&] { write_adjusted(); });
  attempt([&] { write_map_csv(directory_.file("map.csv"), map_); });
  attempt([&] { write_map_ply(directory_.file("map.ply"), map_); });
  attempt([&] {
    const auto survey = summary_.survey_on_map();
    if (!survey.empty()) write_survey_csv(directory_.file("surveyed.csv"), survey);
  });
  attempt([&] { write_series_mat(); });
  attempt([&] {
    if (!finishing) return;
    for (const std::string& warning : finishing(directory_.path())) summary_.warn(warning);
  });

  RunOutcome outcome{status, reason};
  for (const std::string& failure : failures) {
    if (failure == reason) continue;
    outcome.reason = outcome.status == RunStatus::failed ? outcome.reason + "; " + failure : failure;
    outcome.status = RunStatus::failed;
  }
  outcome.report = summary_.report(outcome.status, outcome.reason);
  summary_file_->finish(summary_.json(outcome.status, outcome.reason));
  return outcome;
}

}  // namespace incognita
