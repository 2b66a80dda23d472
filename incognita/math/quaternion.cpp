#include "incognita/math/quaternion.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace incognita {

Eigen::Matrix3d right_jacobian(const Eigen::Vector3d& e) {
  const double a2 = e.squaredNorm();
  const Eigen::Matrix3d k = skew(e);
  if (a2 < 1e-8) return Eigen::Matrix3d::Identity() - 0.5 * k + (1.0 / 6.0) * k * k;
  const double a = std::sqrt(a2);
  return Eigen::Matrix3d::Identity() - (1 - std::cos(a)) / a2 * k + (a - std::sin(a)) / (a2 * a) * k * k;
}

Eigen::Vector4d quaternion_from_matrix(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  return (wxyz[0] < 0 ? Eigen::Vector4d(-wxyz) : wxyz).normalized();
}

}  // namespace incognita
