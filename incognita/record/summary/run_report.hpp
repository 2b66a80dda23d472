// The results of a run as a struct and as a text of about ten lines.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/record/summary/consistency_summary.hpp"
#include "incognita/record/summary/outcome_summary.hpp"
#include "incognita/record/summary/run_status.hpp"

namespace incognita {

/// NaN if there is nothing to compare.
struct BodyReport {
  double path_length = std::numeric_limits<double>::quiet_NaN();    ///< true if known; m, or arbitrary units
  double ate_m = std::numeric_limits<double>::quiet_NaN();          ///< rms, after alignment
  double drift_percent = std::numeric_limits<double>::quiet_NaN();  ///< final position error over true path
  std::int64_t compared_frames = 0;                                 ///< tracked frames with known truth
  PoseConsistency consistency;                                      ///< of its own pose
};

struct RunReport {
  RunStatus status = RunStatus::done;
  std::string reason;
  double duration_s = 0;  ///< from the first frame to the last, in run time
  std::int64_t frames = 0, tracked_frames = 0, degraded_frames = 0, lost_frames = 0;
  AlignmentKind alignment = AlignmentKind::none;
  bool scale_known = true;   ///< else lengths of the estimate are in arbitrary units
  bool truth_known = false;  ///< at any frame
  bool true_path = false;    ///< path lengths are of the true path, known at every frame with a pose
  BodyReport body;           ///< all bodies together
  /// Of the trajectory with its keyframes as bundle adjustment had them last, after an alignment of its own
  double ate_adjusted_m = std::numeric_limits<double>::quiet_NaN();
  std::vector<BodyReport> bodies;
  int landmarks = 0, anchors = 0;
  int surveyed = 0;  ///< landmarks the map can be compared with; 0: none
  /// rms over the matched landmarks, without a survey over those whose truth the simulation knows
  double map_error_m = std::numeric_limits<double>::quiet_NaN();
  int map_error_landmarks = 0;
  double entropy = std::numeric_limits<double>::quiet_NaN();  ///< of bodies and map, nats
  std::optional<double> entropy_extended;                     ///< with what is expected and not mapped yet
  OutcomeMeasures outcome;
  bool in_room = false;  ///< the world is the rendered room, whose surface is mapped; else points are
  ConsistencyReport consistency;
  std::int64_t decisions = 0;
  std::vector<std::string> warnings;
};

/// The report as complete lines. `wall_s`: duration of the run in real time; `out`: its directory.
std::string in_words(const RunReport& report, double wall_s, const std::string& out);

/// A length with a readable unit: 0.00248 m is "2.5 mm".
std::string length_in_words(double length_m);

}  // namespace incognita
