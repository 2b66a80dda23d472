// What summary.json says of a run, gathered snapshot by snapshot.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "incognita/analysis/observability_report.hpp"
#include "incognita/analysis/trajectory.hpp"
#include "incognita/record/exploration_summary.hpp"
#include "incognita/record/snapshot.hpp"
#include "incognita/record/team_summary.hpp"

namespace incognita {

enum class RunStatus { done, failed, interrupted };
const char* name(RunStatus status);

using SummaryValue = std::variant<bool, std::int64_t, double, std::string>;

/// What is known of a run before it starts.
struct RunInfo {
  std::string effective_toml;  ///< every setting in force and where it came from, as text
  std::int64_t seed = 0;
  std::string version;
  std::string ate_alignment = "none";  ///< `none` where anchors fix the frame, `sim3` where the scale is free
  bool truth_recorded = false;         ///< a recording with truth, though the first frames may have none
  std::string body = "camera";         ///< whose pose it is: `camera` or `vehicle`
  bool ranges = false;                 ///< looks are ranges and bearings, not pixels
  int vehicles = 0;                    ///< of a team; 0: there is none
  Eigen::Vector2d steered_m{0, 0};     ///< of a team: the point to be on the path, before and left of its own
  std::vector<std::string> inputs = {};  ///< of a team's vehicles: names with units, e.g. "speed_m_s"
  int patch_size_px = 11;                ///< side of the squares that are searched for, to draw them
  std::vector<std::pair<std::string, SummaryValue>> extra;  ///< more fields for summary.json
};

/// Whether estimate and truth can be compared as they are.
bool same_frame_as_truth(const RunInfo& info);

class RunSummary {
 public:
  /// Throws std::invalid_argument when the alignment is none of `none`, `se3`, `sim3`, `yaw`.
  explicit RunSummary(const RunInfo& info);

  void add(const Snapshot& snapshot);
  /// One more field, or another value for it. Throws std::invalid_argument for a name of the contract's.
  void note(const std::string& key, SummaryValue value);
  void note(const ObservabilityReport& report) { observability_ = report; }
  void warn(const std::string& warning) { warnings_.push_back(warning); }

  /// The JSON document (docs/schemas/summary.schema.json).
  std::string json(RunStatus status, const std::string& reason) const;
  /// How far from the truth, and how sure of that, in a line; empty without truth.
  std::string in_words() const;

 private:
  struct Mean {
    double sum = 0;
    std::int64_t count = 0;
    void add(double value) {
      sum += value;
      ++count;
    }
    /// NaN, that is null in JSON, without values.
    double value() const {
      return count ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
    }
  };

  void compare_with_truth(const Snapshot& snapshot);
  void compare(const StampedPose& truth, const StampedPose& estimate, const PoseCovariance& covariance,
               TrackingState state);
  double ate_m() const;
  /// Of how many frames the errors are, where not of all; of a team, each vehicle's errors over its own
  /// truth.
  std::string where_truth_was_known() const;

  std::string version_;
  std::int64_t seed_;
  AlignmentKind alignment_;
  std::vector<std::pair<std::string, SummaryValue>> extra_;
  std::vector<std::string> warnings_;

  ExplorationSummary exploration_;
  std::int64_t frames_ = 0, tracked_frames_ = 0, lost_frames_ = 0, overconfident_frames_ = 0, decisions_ = 0;
  int landmarks_ = 0, anchors_ = 0;
  SnapshotEntropy entropy_;
  Mean nis_per_dof_, nees_per_dof_;
  bool has_truth_ = false;
  std::optional<ObservabilityReport> observability_;
  MatchedTrajectories matched_;
  std::vector<std::pair<std::string, std::vector<double>>> stage_ms_;
  TeamSummary team_;
};

}  // namespace incognita
