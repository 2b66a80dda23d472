// Estimated trajectories against the true ones, as `incognita evaluate` reports them: of one vehicle, or of a
// team, whose vehicles share one frame and so one alignment, and each of which has its own truth.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

struct TrajectoryFiles {
  std::string estimate, truth, covariance;  ///< no covariance: no NEES
};

struct ComparisonOptions {
  AlignmentKind alignment = AlignmentKind::none;
  double max_dt_s = 0.01;  ///< poses further apart in time do not match
  double rpe_delta_s = 1;  ///< interval of the relative pose error
};

/// Of one vehicle, over the poses at which its truth is known.
struct TrajectoryErrors {
  std::size_t matched = 0, estimate_poses = 0, truth_poses = 0;
  ErrorStatistics ate_m;
  RelativePoseError rpe;
  std::optional<MeanNees> nees;
};

struct TrajectoryComparison {
  Alignment alignment;  ///< one for all vehicles
  std::vector<TrajectoryErrors> vehicles;
  /// Over the poses of all vehicles, each with a truth of its own.
  std::size_t matched = 0, estimate_poses = 0, truth_poses = 0;
  ErrorStatistics ate_m;
  std::optional<MeanNees> nees;
};

/// Nothing where the trajectories cannot be compared; the reason goes to standard error. Throws InputError
/// when a file is wrong.
std::optional<TrajectoryComparison> compare_trajectories(const std::vector<TrajectoryFiles>& vehicles,
                                                         const ComparisonOptions& options);

}  // namespace incognita
