// The numbers of a run over time: what a row of series.csv says about one snapshot.
#pragma once

#include <string>
#include <vector>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Whether there is a pose to speak of: not while starting, and not when lost.
bool has_pose(const Snapshot& snapshot);

StampedPose estimated_pose(const Snapshot& snapshot);
StampedPose true_pose(const Tick& tick, const Truth& truth);
/// Covariance of the pose in PoseCovariance's order.
PoseCovariance pose_covariance(const Snapshot& snapshot);
/// Landmarks in the map that are not anchors.
int mapped_landmarks(const Snapshot& snapshot);

/// Names of the columns after `t` and `state`, units at their end. With errors: truth is known in the same
/// frame. `nis` is the sum, to be divided by `nis_dof`; `nees_per_dof` is divided already. `sigma_position_m`
/// and `sigma_rotation_rad` are the standard deviations in the worst direction.
std::vector<std::string> series_columns(bool with_errors);

/// The numbers of those columns; NaN where there is none, as for everything about the pose without a pose.
std::vector<double> series_row(const Snapshot& snapshot, bool with_errors);

}  // namespace incognita
