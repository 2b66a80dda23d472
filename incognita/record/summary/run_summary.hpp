// Accumulates the content of summary.json snapshot by snapshot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/analysis/observability/observability_report.hpp"
#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/adjusted_path.hpp"
#include "incognita/record/summary/consistency_summary.hpp"
#include "incognita/record/summary/exploration_summary.hpp"
#include "incognita/record/summary/map_survey.hpp"
#include "incognita/record/summary/outcome_summary.hpp"
#include "incognita/record/summary/path_distance.hpp"
#include "incognita/record/summary/path_summary.hpp"
#include "incognita/record/summary/run_info.hpp"
#include "incognita/record/summary/run_report.hpp"
#include "incognita/record/summary/run_status.hpp"

namespace incognita {

class RunSummary {
 public:
  /// Throws std::invalid_argument if the alignment is not `none`, `se3`, `sim3` or `yaw`.
  explicit RunSummary(const RunInfo& info);

  void add(const Snapshot& snapshot);
  /// Adds or replaces a field. Throws std::invalid_argument for a name that the schema defines.
  void note(const std::string& key, SummaryValue value);
  void note(const ObservabilityReport& report) { observability_ = report; }
  void warn(const std::string& warning) { warnings_.push_back(warning); }

  /// The JSON document (docs/schemas/summary.schema.json).
  std::string json(RunStatus status, const std::string& reason) const;
  RunReport report(RunStatus status, const std::string& reason) const;
  /// The trajectory after bundle adjustment; empty without one.
  Trajectory adjusted_trajectory() const { return adjusted_.trajectory(); }
  /// The surveyed landmarks in the map frame; empty if the two cannot be aligned.
  std::vector<SurveyedLandmark> survey_on_map() const;

 private:
  std::optional<Alignment> truth_from_map() const;
  void compare_with_truth(const Snapshot& snapshot);
  MatchedTrajectories all_matched() const;
  void report_paths(RunReport& report) const;
  double ate_adjusted_m() const;
  void report_map(RunReport& report) const;

  std::string version_;
  std::int64_t seed_;
  bool in_room_;
  AlignmentKind alignment_;
  std::vector<std::pair<std::string, SummaryValue>> extra_;

  ExplorationSummary exploration_;
  OutcomeSummary outcome_;
  std::int64_t frames_ = 0, tracked_frames_ = 0, degraded_frames_ = 0, lost_frames_ = 0, decisions_ = 0;
  double first_t_s_ = 0, last_t_s_ = 0;
  int landmarks_ = 0, anchors_ = 0;
  SnapshotEntropy entropy_;  ///< the last known
  ConsistencySummary consistency_;
  PathSummary paths_;
  AdjustedPath adjusted_;
  Survey survey_;
  std::vector<std::string> warnings_;
  std::vector<SnapshotLandmark> map_;  ///< of the last frame, if there is a survey
  bool has_truth_ = false;
  std::optional<ObservabilityReport> observability_;
  std::vector<MatchedTrajectories> matched_;  ///< per body
  std::vector<std::pair<std::string, std::vector<double>>> stage_ms_;
  PathDistanceSummary distances_;
};

}  // namespace incognita
