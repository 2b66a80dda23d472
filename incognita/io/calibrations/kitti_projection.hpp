// The projection of a rectified camera of KITTI.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

namespace incognita {

/// From coordinates in camera 0, in m, to the image, in px: K [I | -center] with the center of this camera.
using KittiProjection = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// The line `name` ("P2") of a calibration file; nullopt if it has none. Throws InputError naming file and line if these are not 12
/// numbers with focal lengths of more than 0.
std::optional<KittiProjection> kitti_projection(const std::filesystem::path& file, const std::string& name);

}  // namespace incognita
