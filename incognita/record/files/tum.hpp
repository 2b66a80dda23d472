// Trajectories and pose covariances from text files, as the field writes them.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Reads a trajectory. Either TUM's `t x y z qx qy qz qw` (seconds, blanks or commas between, `#` starts a
/// comment) or EuRoC's ground-truth table, known by its header `#timestamp,...` or `timestamp,...`
/// whose names are not TUM's (`tx`, or `qx` before `qw`): nanoseconds, position, quaternion with w first,
/// more columns not read. Throws InputError naming file, line and remedy on anything else: numbers missing or
/// not finite, a quaternion whose length is more than 1 % from 1, no pose at all. A comment that says
/// `orientation is not known`, as a run's truth.tum may, goes for all poses.
Trajectory read_trajectory(const std::filesystem::path& path);

/// Reads a run's covariance.csv: t and 36 numbers a row, row-major, order x y z rotX rotY rotZ. Throws
/// InputError.
std::vector<StampedCovariance> read_covariances(const std::filesystem::path& path);

}  // namespace incognita
