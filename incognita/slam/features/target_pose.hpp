// Detection of the known target in an image, and the camera pose relative to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/models/sensors/camera_measurement.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

struct TargetPose {
  Eigen::Vector3d position;  ///< of the camera, world, m
  Eigen::Vector4d world_from_camera;
  Eigen::Matrix<double, 6, 6> covariance;  ///< of position and right rotation error, from the pixel noise
  std::vector<Eigen::Vector2d> pixels;     ///< detected corners, px
  double rms_px = 0;                       ///< reprojection error
  double second_rms_px = 0;                ///< of the second pose of a flat target; near rms_px: ambiguous
};

struct TargetSearch {
  std::optional<TargetPose> pose;
  std::string reason;  ///< why there is no pose
};

/// Searches the whole image for the patches of four distant corners by correlation, and tests the
/// combinations of the best candidates. The pose is then refined with all corners, each at the intersection
/// of its edges near the first projection. The image must match the target's picture, if it has one, and the
/// second pose that a flat target allows must fit worse or be near.
TargetSearch find_target(const Target& target, const Camera& camera, const SummedImage& image,
                         double sigma_pixel_px);

/// The poses that project coplanar points (world) to these pixels, best first, refined on the exact camera
/// model. At most two.
std::vector<TargetPose> solve_pose(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Eigen::Vector2d>& pixels, const Camera& camera,
                                   double sigma_pixel_px);

}  // namespace incognita
