// Compares estimated with true trajectories for `incognita evaluate`. The vehicles of a team share one frame
// and therefore one alignment; each has its own truth.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

struct TrajectoryFiles {
  std::string estimate, truth, covariance;  ///< without covariance, no NEES
};

struct ComparisonOptions {
  AlignmentKind alignment = AlignmentKind::none;
  double max_dt_s = 0.01;  ///< poses further apart in time are not matched
  double rpe_delta_s = 1;  ///< interval of the relative pose error
};

/// Errors of one vehicle over the poses with known truth.
struct TrajectoryErrors {
  std::size_t matched = 0, estimate_poses = 0, truth_poses = 0;
  ErrorStatistics ate_m;
  RelativePoseError rpe;
  std::optional<MeanNees> nees;
};

struct TrajectoryComparison {
  Alignment alignment;  ///< one for all vehicles
  std::vector<TrajectoryErrors> vehicles;
  /// Over the poses of all vehicles, each compared with its own truth.
  std::size_t matched = 0, estimate_poses = 0, truth_poses = 0;
  ErrorStatistics ate_m;
  std::optional<MeanNees> nees;
};

/// Returns nullopt if the trajectories cannot be compared, and prints the reason to standard error. Throws
/// InputError if a file is invalid.
std::optional<TrajectoryComparison> compare_trajectories(const std::vector<TrajectoryFiles>& vehicles,
                                                         const ComparisonOptions& options);

}  // namespace incognita
