#include "incognita/models/sensors/wide_angle_camera.hpp"

#include <cmath>

#include "incognita/models/sensors/check_image.hpp"

namespace incognita {

Projection WideAngleCamera::project(const Eigen::Vector3d& point) const {
  const double iz = 1 / point.z();
  const Eigen::Vector2d c(fu * point.x() * iz, fv * point.y() * iz);
  const double d = 1 + 2 * kd1 * c.squaredNorm(), root_d = std::sqrt(d);
  const Eigen::Matrix2d radial =
      (Eigen::Matrix2d::Identity() - 2 * kd1 / d * c * c.transpose()) / root_d;  // d(pixel)/d(c)
  Eigen::Matrix<double, 2, 3> pinhole;
  pinhole << fu * iz, 0, -c.x() * iz, 0, fv * iz, -c.y() * iz;
  return {Eigen::Vector2d(u0 + c.x() / root_d, v0 + c.y() / root_d), radial * pinhole};
}

std::optional<Eigen::Vector3d> WideAngleCamera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d c = pixel - Eigen::Vector2d(u0, v0);
  const double d = 1 - 2 * kd1 * c.squaredNorm();
  if (!(d > 1e-9)) return std::nullopt;  // beyond the image of points at infinity
  const double k = 1 / std::sqrt(d);
  return Eigen::Vector3d(c.x() * k / fu, c.y() * k / fv, 1);
}

void WideAngleCamera::check() const {
  check_image(*this);
  need(std::isfinite(kd1) && kd1 >= 0, "camera kd1_per_px2 must be zero or positive", kd1);
}

}  // namespace incognita
