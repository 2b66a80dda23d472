// The rotation of a camera between two frames, from whole images at low resolution: G. Klein, D. Murray, "Improving the
// agility of keyframe-based SLAM", ECCV 2008. It says where features move in fast rotations and in blurred images, before
// any of them is searched for.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/models/sensors/camera.hpp"
#include "incognita/vision/small_image.hpp"

namespace incognita {

/// Rays of the pixels of a small image, row by row, in camera axes; zero where the lens defines none.
std::vector<Eigen::Vector3d> rays_of(const SmallImage& image, const Camera& camera);

struct RotationAlignment {
  Eigen::Matrix3d rotation =
      Eigen::Matrix3d::Identity();  ///< of predicted rays, in axes of the current camera
  double rms_initial = 0;           ///< difference of the images as predicted, in their standard deviations
  double rms = 0;                   ///< and at the result, at most rms_initial
};

/// Gauss-Newton from the identity. `rays`: of the pixels of `before`, row by row, in the axes of the current camera as
/// predicted by the filter, of any length and zero where there is none. Translation beyond the prediction is not
/// estimated: it is taken for the rotation that moves the image alike. Nothing when less than half of the images overlaps,
/// or they do not determine a rotation.
std::optional<RotationAlignment> align_rotation(const SmallImage& before, const SmallImage& now,
                                                const std::vector<Eigen::Vector3d>& rays,
                                                const Camera& camera);

}  // namespace incognita
