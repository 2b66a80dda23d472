// What a run achieved, for the person who started it: one struct, and about ten lines of text.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/record/summary/consistency_summary.hpp"
#include "incognita/record/summary/run_status.hpp"

namespace incognita {

/// NaN where there is nothing to compare.
struct BodyReport {
  double path_length = std::numeric_limits<double>::quiet_NaN();  ///< true where known; m, or arbitrary units
  double ate_m = std::numeric_limits<double>::quiet_NaN();        ///< rms, after the alignment of the run
  double drift_percent = std::numeric_limits<double>::quiet_NaN();  ///< last position error over true path
  std::int64_t compared_frames = 0;  ///< of tracked_frames, those at which its truth is known
  PoseConsistency consistency;       ///< of a robot of a team
};

struct RunReport {
  RunStatus status = RunStatus::done;
  std::string reason;
  double duration_s = 0;  ///< from the first frame to the last, in the time of the run
  std::int64_t frames = 0, tracked_frames = 0, degraded_frames = 0, lost_frames = 0;
  AlignmentKind alignment = AlignmentKind::none;
  bool scale_known = true;   ///< else lengths of the estimate have an arbitrary unit
  bool truth_known = false;  ///< at any frame
  bool true_path = false;    ///< path lengths are those of the true path, known at every frame with a pose
  BodyReport body;           ///< of a team: of all its robots together
  std::vector<BodyReport> robots;
  int landmarks = 0, anchors = 0;
  int surveyed = 0;  ///< landmarks that the map can be compared with; 0: none
  double map_error_m = std::numeric_limits<double>::quiet_NaN();  ///< rms over the matched ones
  int map_error_landmarks = 0;
  ConsistencyReport consistency;
  std::int64_t decisions = 0;
  std::vector<std::string> warnings;
};

/// The lines, each ended. `wall_s`: how long the run took; `out`: where its files are.
std::string in_words(const RunReport& report, double wall_s, const std::string& out);

/// 0.00248 m is "2.5 mm": a length as people say it.
std::string length_in_words(double length_m);

}  // namespace incognita
