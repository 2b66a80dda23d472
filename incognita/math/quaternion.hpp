// Unit quaternions (w, x, y, z), rotation vectors and the rotation group, for any scalar type.
//
// A quaternion is a Vector4 in the order w, x, y, z. world_from_camera rotates vectors from the camera frame to the
// world frame: x_world = rotation_matrix(world_from_camera) * x_camera. Rotation vectors are in radians.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace incognita {

template <class S>
using Vector2 = Eigen::Matrix<S, 2, 1>;
template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vector4 = Eigen::Matrix<S, 4, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;

/// Cross-product matrix: skew(a) * b = a x b.
template <class S>
Matrix3<S> skew(const Vector3<S>& a) {
  Matrix3<S> m;
  m << S(0), -a.z(), a.y(), a.z(), S(0), -a.x(), -a.y(), a.x(), S(0);
  return m;
}

/// Hamilton product a * b.
template <class S>
Vector4<S> quaternion_product(const Vector4<S>& a, const Vector4<S>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

template <class S>
Vector4<S> quaternion_conjugate(const Vector4<S>& q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

/// Rotation matrix of a unit quaternion.
template <class S>
Matrix3<S> rotation_matrix(const Vector4<S>& q) {
  const S w = q[0], x = q[1], y = q[2], z = q[3];
  Matrix3<S> r;
  r << S(1) - S(2) * (y * y + z * z), S(2) * (x * y - w * z), S(2) * (x * z + w * y),  //
      S(2) * (x * y + w * z), S(1) - S(2) * (x * x + z * z), S(2) * (y * z - w * x),   //
      S(2) * (x * z - w * y), S(2) * (y * z + w * x), S(1) - S(2) * (x * x + y * y);
  return r;
}

/// Unit quaternion of a rotation vector e: (cos(|e|/2), sin(|e|/2) e/|e|). Smooth at zero, also for dual numbers.
template <class S>
Vector4<S> quaternion_exp(const Vector3<S>& e) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const S angle_squared = e.squaredNorm();
  if (angle_squared < S(1e-8)) {  // Taylor series of sin(a/2)/a and cos(a/2), exact to 1e-17 here
    const S k = S(0.5) - angle_squared * S(1.0 / 48.0);
    return {S(1) - angle_squared * S(0.125), k * e.x(), k * e.y(), k * e.z()};
  }
  const S angle = sqrt(angle_squared);
  const S k = sin(angle * S(0.5)) / angle;
  return {cos(angle * S(0.5)), k * e.x(), k * e.y(), k * e.z()};
}

/// Rotation vector of a unit quaternion, of norm at most pi: the inverse of quaternion_exp.
template <class S>
Vector3<S> quaternion_log(const Vector4<S>& q_any_sign) {
  using std::atan2;
  using std::sqrt;
  const Vector4<S> q = q_any_sign[0] < S(0) ? Vector4<S>(-q_any_sign) : q_any_sign;
  const Vector3<S> v = q.template tail<3>();
  const S norm_squared = v.squaredNorm();
  // Taylor series of atan2(n, w)/n around n = 0, to second order in n
  if (norm_squared < S(1e-10)) return v * (S(2) / q[0] * (S(1) - norm_squared / (S(3) * q[0] * q[0])));
  const S norm = sqrt(norm_squared);
  return v * (S(2) * atan2(norm, q[0]) / norm);
}

/// Rotation matrix of a rotation vector (Rodrigues).
template <class S>
Matrix3<S> rotation_exp(const Vector3<S>& e) {
  return rotation_matrix(quaternion_exp(e));
}

/// Right Jacobian of SO(3): exp(e + d) = exp(e) exp(J_r(e) d) to first order in d (Sola et al. 2018, eq. 143).
Eigen::Matrix3d right_jacobian(const Eigen::Vector3d& e);

/// Unit quaternion of a rotation matrix, with w >= 0. Accurate for all rotations (Shepperd's method).
Eigen::Vector4d quaternion_from_matrix(const Eigen::Matrix3d& rotation);

}  // namespace incognita
