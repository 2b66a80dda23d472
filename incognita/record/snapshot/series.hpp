// The time series of a run: the row of series.csv for one snapshot.
#pragma once

#include <string>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Whether the estimated pose of a body is valid: not while starting or lost.
bool has_pose(const SnapshotBody& body);

/// Number of landmarks in the map, without anchors.
int mapped_landmarks(const Snapshot& snapshot);

/// Column names after `t` and `state`, ending with their units. `with_errors`: the truth is known in the
/// frame of the estimate. `nis` is a sum, to be divided by `nis_dof`; `nees_per_dof` is already divided.
/// `sigma_position_m` and `sigma_rotation_rad` are standard deviations in the worst direction.
std::vector<std::string> series_columns(bool with_errors);

/// The values of those columns, the pose of the first body; NaN if unknown, e.g. all pose columns without a valid pose.
std::vector<double> series_row(const Snapshot& snapshot, bool with_errors);

}  // namespace incognita
