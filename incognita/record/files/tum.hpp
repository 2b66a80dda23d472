// Reads trajectories and pose covariances from text files in the common formats.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Reads a trajectory in TUM format, `t x y z qx qy qz qw` (t in s, separated by blanks or commas, `#` starts
/// a comment), or the EuRoC ground-truth table (t in ns, position, quaternion with w first, further columns
/// ignored). The EuRoC table is recognized by a header `#timestamp,...` or `timestamp,...` whose column names
/// are not TUM's (`tx`, or `qx` before `qw`). Throws InputError naming file, line and remedy for missing or
/// non-finite numbers, a quaternion whose norm is more than 1 % from 1, or a file without poses. A comment
/// `orientation is not known`, which a run's truth.tum may contain, applies to all poses.
Trajectory read_trajectory(const std::filesystem::path& path);

/// Reads a run's covariance.csv: t and a row-major 6x6 covariance per row, order x y z rotX rotY rotZ (m,
/// rad). Throws InputError.
std::vector<StampedCovariance> read_covariances(const std::filesystem::path& path);

}  // namespace incognita
