// Writes the run directory during the run.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/record/body_tables.hpp"
#include "incognita/record/files/padded_file.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/record/mcap/snapshot_log.hpp"
#include "incognita/record/run_directory.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/run_summary.hpp"
#include "incognita/record/summary/timing_table.hpp"

namespace incognita {

/// Final content of summary.json.
struct RunOutcome {
  RunStatus status = RunStatus::done;
  std::string reason;
  RunReport report = {};  ///< the results; status and reason as above
};

/// Writes a run directory with these files:
///
/// - effective.toml: the settings in force, as passed by the caller.
/// - estimate.tum, truth.tum: `t x y z qx qy qz qw`, world_from_camera. estimate.tum has no row while
///   starting or lost. There is no truth.tum if the truth is unknown.
/// - adjusted.tum: the same poses with the keyframes as bundle adjustment had them last, if there was one; at the end.
/// - covariance.csv: t and the row-major 6x6 covariance of each row of estimate.tum, order x y z rotX rotY
///   rotZ: position in the world (m), rotation as right error in camera axes (rad), q_true = q * exp(rot/2).
/// - series.csv: see series_columns(). measurements.csv: every measurement with its association.
/// - vehicles.csv, actions.csv, and for several bodies the files of each: see BodyTables.
/// - interventions.jsonl: what a person did to the run, if anything: snapshot/interventions.hpp.
/// - timings.csv: milliseconds per stage.
/// - run.mcap: the snapshots, for replay and for viewers; see SnapshotLog.
/// - map.csv, map.ply, series.mat, and surveyed.csv if landmarks are surveyed: at the end. summary.json:
///   created at the start and updated about once per second.
///
/// The same snapshots give the same bytes in all files but timings.csv, series.mat and summary.json. An
/// earlier run in the same folder is removed first.
class Recorder {
 public:
  /// Throws RecordError, leaving nothing behind, if the folder cannot be created or written.
  Recorder(const std::filesystem::path& directory, const RunInfo& info);

  /// Throws RecordError if a write fails; the caller then calls finish() with that reason. What was recorded stays.
  void publish(const Snapshot& snapshot);
  /// Interventions of a tick without a snapshot, since it failed.
  void log(const Tick& tick, const std::vector<Intervention>& interventions);

  /// Adds a field to summary.json. Throws std::invalid_argument for a name that its schema defines.
  void note(const std::string& key, SummaryValue value) { summary_.note(key, std::move(value)); }
  /// Adds the observability report to summary.json.
  void note(const ObservabilityReport& report) { summary_.note(report); }

  const std::filesystem::path& path() const { return directory_.path(); }

  /// Writes the final files, then lets `finishing` add to the directory (figures; it returns warnings and
  /// throws RecordError), then completes summary.json. A file that cannot be written is left out and makes
  /// the run `failed`. Throws RecordError only if summary.json itself cannot be written.
  using Finishing = std::function<std::vector<std::string>(const std::filesystem::path& directory)>;
  RunOutcome finish(RunStatus status, const std::string& reason, const Finishing& finishing = {});

 private:
  void open_files(const RunInfo& info);
  void write_pose(const Snapshot& snapshot);
  void write_series(const Snapshot& snapshot);
  void write_matches(const Snapshot& snapshot);
  void refresh_summary(double t_s);
  void open_series();
  void write_series_mat() const;
  void write_adjusted() const;

  RunInfo info_;
  bool compare_with_truth_;
  RunSummary summary_;
  RunDirectory directory_;
  std::optional<PaddedFile> summary_file_;
  RowFile estimate_, truth_, covariance_, series_, matches_, interventions_;
  TimingTable timings_;
  std::optional<BodyTables> bodies_;
  std::optional<SnapshotLog> log_;

  bool truth_opened_ = false;
  std::optional<bool> with_errors_;  ///< whether series.csv has error columns; set by the first snapshot
  std::vector<std::vector<double>> series_columns_;  ///< for the MAT file: t, state, then series.csv
  std::vector<SnapshotLandmark> map_;                ///< of the last snapshot
  std::optional<double> summary_t_s_, first_t_s_;
};

}  // namespace incognita
