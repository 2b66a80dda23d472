#include "incognita/models/motion/mount.hpp"

#include <cmath>

namespace incognita {

PoseOf<3> on_floor(const planar::Pose<double>& pose) { return pose_on_floor<3>(pose[0], pose[1], pose[2]); }

Matrix3<double> Mount::body_from_camera() const {
  const double c = std::cos(pitch_rad), s = std::sin(pitch_rad);
  const Matrix3<double> pitched = (Matrix3<double>() << 0, s, c, -1, 0, 0, 0, -c, s).finished();
  return rotation_exp<double>(Vector3<double>(0, 0, yaw_rad)) * pitched;
}

}  // namespace incognita
