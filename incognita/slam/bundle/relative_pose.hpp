// The pose of a second camera relative to a first, from rays to the same unknown points: Nister, "An efficient solution to the
// five-point relative pose problem" (2004), with RANSAC. Needs no initial value.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace incognita {

struct RelativePose {
  Eigen::Vector4d first_from_second{1, 0, 0, 0};  ///< unit quaternion w, x, y, z
  Eigen::Vector3d direction{0, 0, 1};  ///< from the first to the second camera, first axes, unit length
  std::vector<bool> is_inlier;         ///< of each ray: near its epipolar line, and in front of both cameras
};

/// `first`, `second`: rays (x, y, 1) of the same points. `tolerance`: distance from the epipolar line, in the units of x and y.
/// Nothing with fewer than 8 rays or without a solution. The same rays give the same pose.
std::optional<RelativePose> relative_pose(const std::vector<Eigen::Vector3d>& first,
                                          const std::vector<Eigen::Vector3d>& second, double tolerance);

}  // namespace incognita
