#include "incognita/models/sensors/pinhole_camera.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/models/sensors/check_image.hpp"

namespace incognita {

bool PinholeCamera::defined(const Eigen::Vector3d& point) const {
  return point.z() > 1e-9 && one_to_one(point.head<2>() / point.z());
}

Projection PinholeCamera::project(const Eigen::Vector3d& point) const {
  const double iz = 1 / point.z();
  const Eigen::Vector2d c = point.head<2>() * iz;
  Eigen::Matrix<double, 2, 3> flat;  // d(c)/d(point)
  flat << iz, 0, -c.x() * iz, 0, iz, -c.y() * iz;
  const Eigen::Vector2d d = distort<double>(c);
  return {Eigen::Vector2d(u0 + fu * d.x(), v0 + fv * d.y()),
          Eigen::Vector2d(fu, fv).asDiagonal() * distortion_jacobian(c) * flat};
}

std::optional<Eigen::Vector3d> PinholeCamera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d wanted((pixel.x() - u0) / fu, (pixel.y() - v0) / fv);
  if (!wanted.allFinite()) return std::nullopt;
  Eigen::Vector2d c = wanted;
  for (int halvings = 0; !one_to_one(c); ++halvings) {
    if (halvings == 60) return std::nullopt;
    c *= 0.5;
  }
  constexpr int max_steps = 50;  // 3 to 6 suffice in ordinary images
  for (int i = 0; i < max_steps; ++i) {
    const Eigen::Vector2d missing = wanted - distort<double>(c);
    if (missing.norm() <= 1e-13 * (1 + wanted.norm())) return Eigen::Vector3d(c.x(), c.y(), 1);
    const std::optional<Eigen::Vector2d> better = newton_step(c, wanted, missing);
    if (!better) break;
    c = *better;
  }
  // the tolerance above may be below the rounding error; 1e-6 px is sufficient
  const bool close = (wanted - distort<double>(c)).norm() * std::max(fu, fv) < 1e-6;
  if (!close || !one_to_one(c)) return std::nullopt;
  return Eigen::Vector3d(c.x(), c.y(), 1);
}

void PinholeCamera::check() const {
  check_image(*this);
  need(std::isfinite(k1), "camera k1 must be finite", k1);
  need(std::isfinite(k2), "camera k2 must be finite", k2);
  need(std::isfinite(p1), "camera p1 must be finite", p1);
  need(std::isfinite(p2), "camera p2 must be finite", p2);
  need(std::isfinite(k3), "camera k3 must be finite", k3);
}

Eigen::Matrix2d PinholeCamera::distortion_jacobian(const Eigen::Vector2d& c) const {
  const double x = c.x(), y = c.y(), s = c.squaredNorm();
  const double radial = 1 + s * (k1 + s * (k2 + s * k3));
  const double slope = 2 * (k1 + s * (2 * k2 + s * 3 * k3));  // d(radial)/dx = slope x
  const double mixed = slope * x * y + 2 * p1 * x + 2 * p2 * y;
  Eigen::Matrix2d J;
  J << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, mixed,  //
      mixed, radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return J;
}

double PinholeCamera::determinant(const Eigen::Matrix2d& J) { return J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0); }

bool PinholeCamera::one_to_one(const Eigen::Vector2d& c) const {
  const double s = c.squaredNorm();
  if (!std::isfinite(s)) return false;
  // d(r radial)/dr as a polynomial in s = r^2 is 1 at the axis and must stay positive up to c
  const double a = 3 * k1, b = 5 * k2, d = 7 * k3;
  const auto rises = [&](double at) { return 1 + at * (a + at * (b + at * d)) > 0; };
  const auto rises_if_between = [&](double at) { return !(at > 0 && at < s) || rises(at); };
  if (!rises(s)) return false;
  const double root = b * b - 3 * a * d;  // discriminant of its extrema, a + 2 b s + 3 d s^2 = 0
  if (d != 0 && root > 0) {
    const double q = -(b + std::copysign(std::sqrt(root), b));  // root formula without cancellation
    if (!rises_if_between(q / (3 * d)) || (q != 0 && !rises_if_between(a / q))) return false;
  } else if (d == 0 && b != 0 && !rises_if_between(-a / (2 * b))) {
    return false;
  }
  return determinant(distortion_jacobian(c)) > 0;  // the tangential terms can also fold
}

std::optional<Eigen::Vector2d> PinholeCamera::newton_step(const Eigen::Vector2d& c,
                                                          const Eigen::Vector2d& wanted,
                                                          const Eigen::Vector2d& missing) const {
  const Eigen::Matrix2d J = distortion_jacobian(c);
  Eigen::Matrix2d adjugate;
  adjugate << J(1, 1), -J(0, 1), -J(1, 0), J(0, 0);
  Eigen::Vector2d step = adjugate * missing / determinant(J);
  for (int halvings = 0; halvings < 40; ++halvings, step *= 0.5) {
    const Eigen::Vector2d next = c + step;
    if (one_to_one(next) && (wanted - distort<double>(next)).norm() < missing.norm()) return next;
  }
  return std::nullopt;
}

}  // namespace incognita
