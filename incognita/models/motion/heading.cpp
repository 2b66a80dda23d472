#include "incognita/models/motion/heading.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/math/quaternion.hpp"

namespace incognita {

double heading_of(const Eigen::Vector4d& world_from_camera) {
  const Eigen::Matrix3d axes = rotation_matrix(world_from_camera);
  const Eigen::Vector3d forward = axes.col(2), up = -axes.col(1);
  constexpr double nearly_vertical = 0.999;
  if (forward.z() > nearly_vertical) return std::atan2(-up.y(), -up.x());
  if (forward.z() < -nearly_vertical) return std::atan2(up.y(), up.x());
  return std::atan2(forward.y(), forward.x());
}

Eigen::Vector4d level_gaze(double heading_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  // Columns: the camera's right, down and forward axes in the world
  const Eigen::Matrix3d axes = (Eigen::Matrix3d() << s, 0, c, -c, 0, s, 0, -1, 0).finished();
  return quaternion_from_matrix(axes);
}

Eigen::Vector4d gaze_at(double heading_rad, double elevation_rad) {
  return quaternion_product<double>(level_gaze(heading_rad),
                                    quaternion_exp<double>(Eigen::Vector3d(elevation_rad, 0, 0)));
}

double elevation_of(const Eigen::Vector4d& world_from_camera) {
  return std::asin(std::clamp(rotation_matrix(world_from_camera)(2, 2), -1.0, 1.0));
}

}  // namespace incognita
