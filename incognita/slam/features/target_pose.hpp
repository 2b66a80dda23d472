// Finding the known target in an image, and the camera from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/models/camera_measurement.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

struct TargetPose {
  Eigen::Vector3d position;  ///< of the camera, world, m
  Eigen::Vector4d world_from_camera;
  Eigen::Matrix<double, 6, 6> covariance;  ///< of position and right rotation error, from the pixels' noise
  std::vector<Eigen::Vector2d> pixels;     ///< where each corner was found, px
  double rms_px = 0;                       ///< of the reprojection
  double second_rms_px =
      0;  ///< of the other pose that a flat target allows; near rms_px the two cannot be told apart
};

struct TargetSearch {
  std::optional<TargetPose> pose;
  std::string reason;  ///< why there is none
};

/// Looks for four corner patches, those farthest apart, in the whole image by correlation, and tries the
/// combinations of the best places. The pose is then solved again from all corners, each taken from the edges
/// around where the first pose puts it; what is seen from there must be the target's picture, if it has one,
/// and the other pose that a flat target allows must fit worse, or be near.
TargetSearch find_target(const Target& target, const Camera& camera, const SummedImage& image,
                         double sigma_pixel_px);

/// The poses from which coplanar points (world) are seen at these pixels, best first, refined on the exact
/// camera model. At most two.
std::vector<TargetPose> solve_pose(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Eigen::Vector2d>& pixels, const Camera& camera,
                                   double sigma_pixel_px);

}  // namespace incognita
