// Corrections of poses, e.g. by bundle adjustment, and their interpolation.
#pragma once

#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita {

/// Position, m, and rotation vector, rad, both in world axes.
struct PoseCorrection {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
};

/// That takes the position and the orientation `from` to those of `to`, whatever their times.
PoseCorrection correction(const StampedPose& from, const StampedPose& to);
StampedPose corrected(StampedPose pose, const PoseCorrection& correction);
/// `share` of the way from `a`, 0, to `b`, 1.
PoseCorrection between(const PoseCorrection& a, const PoseCorrection& b, double share);

}  // namespace incognita
