#include "incognita/models/camera_look.hpp"

#include <Eigen/LU>
#include <cmath>

namespace incognita {
namespace {

/// d(pixel)/d(camera error) for a vector c = C (s X - s p) in camera axes, d = d(pixel)/dc, C =
/// camera_from_world: the position moves c by -s C, the right rotation error by [c]x.
CameraLookJacobian camera_jacobian(const Eigen::Matrix<double, 2, 3>& d,
                                   const Eigen::Matrix3d& camera_from_world, const Eigen::Vector3d& c,
                                   double s) {
  CameraLookJacobian H = CameraLookJacobian::Zero();
  H.leftCols<3>() = -s * d * camera_from_world;
  H.middleCols<3>(3) = d * skew(c);
  return H;
}

}  // namespace

std::optional<PointLandmark::Look> PointLandmark::look(const Camera& camera, const CameraState& x,
                                                       const State& point) {
  const Eigen::Matrix3d camera_from_world = rotation_matrix<double>(free_camera::orientation(x)).transpose();
  const Eigen::Vector3d c = camera_from_world * (point - free_camera::position(x));
  const auto seen = camera.project(c);
  if (!seen) return std::nullopt;
  return Look{seen->pixel, camera_jacobian(seen->J, camera_from_world, c, 1), seen->J * camera_from_world};
}

std::optional<InverseDepthLandmark::Look> InverseDepthLandmark::look(const Camera& camera,
                                                                     const CameraState& x,
                                                                     const State& y) const {
  const Eigen::Matrix3d camera_from_world = rotation_matrix<double>(free_camera::orientation(x)).transpose();
  const Eigen::Vector3d c = in_camera<double>(x, y);
  const auto seen = camera.project(c);
  if (!seen) return std::nullopt;
  Look look{seen->pixel, camera_jacobian(seen->J, camera_from_world, c, y[5]), {}};
  const Eigen::Matrix<double, 2, 3> d_world = seen->J * camera_from_world;
  look.Hl.leftCols<3>() = y[5] * d_world;
  look.Hl.middleCols<2>(3) = d_world * rotation_matrix<double>(world_from_birth).leftCols<2>();
  look.Hl.col(5) = d_world * (y.head<3>() - free_camera::position(x));
  return look;
}

std::optional<InverseDepthLandmark::Birth> InverseDepthLandmark::birth(const Camera& camera,
                                                                       const CameraState& x,
                                                                       const Eigen::Vector2d& pixel,
                                                                       double inverse_depth) {
  const auto ray = camera.unproject(pixel);
  if (!ray) return std::nullopt;
  const auto seen = camera.project(*ray);
  if (!seen) return std::nullopt;
  Birth birth;
  birth.world_from_birth = free_camera::orientation(x);
  birth.landmark << free_camera::position(x), ray->x(), ray->y(), inverse_depth;
  birth.Jv.setZero();
  birth.Jv.topLeftCorner<3, 3>().setIdentity();
  // The axes of birth stay while the camera turns by its error e: the ray becomes r + e x r, then z = 1 again
  const Eigen::Matrix3d turned = -skew<double>(*ray);
  birth.Jv.block<2, 3>(3, 3) = turned.topRows<2>() - ray->head<2>() * turned.row(2);
  birth.Jz.setZero();
  birth.Jz.block<2, 2>(3, 0) = seen->J.leftCols<2>().inverse();
  return birth;
}

InverseDepthLandmark::Point InverseDepthLandmark::point(const State& y) const {
  const Eigen::Matrix3d axes = rotation_matrix<double>(world_from_birth);
  const Eigen::Vector3d ray = axes * Eigen::Vector3d(y[3], y[4], 1);
  Point p{y.head<3>() + ray / y[5], {}};
  p.J.leftCols<3>().setIdentity();
  p.J.middleCols<2>(3) = axes.leftCols<2>() / y[5];
  p.J.col(5) = -ray / (y[5] * y[5]);
  return p;
}

double InverseDepthLandmark::linearity_index(const State& y, double inverse_depth_var,
                                             const Eigen::Vector3d& camera_position) const {
  if (!(y[5] > 0)) return 1e9;
  const Eigen::Vector3d at = point(y).position;
  const Eigen::Vector3d from_birth = at - y.head<3>(), from_camera = at - camera_position;
  const double d0 = from_birth.norm(), d1 = from_camera.norm();
  if (d0 < 1e-9 || d1 < 1e-9) return 1e9;
  // Along the ray: depth = |ray| / rho, so its sigma is |ray| sigma_rho / rho^2
  const double sigma_depth = d0 * std::sqrt(inverse_depth_var) / y[5];
  const double cos_parallax = from_birth.dot(from_camera) / (d0 * d1);
  return 4 * sigma_depth / d1 * std::abs(cos_parallax);
}

}  // namespace incognita
