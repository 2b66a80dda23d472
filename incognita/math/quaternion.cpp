#include "incognita/math/quaternion.hpp"

#include <Eigen/Geometry>

namespace incognita {

Eigen::Vector4d quaternion_from_matrix(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  return (wxyz[0] < 0 ? Eigen::Vector4d(-wxyz) : wxyz).normalized();
}

}  // namespace incognita
