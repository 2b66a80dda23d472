// Pinhole camera with the distortion of OpenCV: three radial and two tangential terms (Brown 1966, as in
// OpenCV's calib3d documentation).
//
//   x = X/Z, y = Y/Z, s = x^2 + y^2, radial = 1 + k1 s + k2 s^2 + k3 s^3
//   x_d = x radial + 2 p1 x y + p2 (s + 2 x^2),  y_d = y radial + p1 (s + 2 y^2) + 2 p2 x y
//   u = u0 + fu x_d,  v = v0 + fv y_d
#pragma once

#include <cmath>
#include <string>

#include "incognita/models/sensors/camera.hpp"

namespace incognita {

struct PinholeCamera {
  int width = 320;
  int height = 240;
  double fu = 195;    ///< focal length over pixel width, px
  double fv = 195;    ///< focal length over pixel height, px
  double u0 = 159.5;  ///< principal point, px
  double v0 = 119.5;
  double k1 = 0, k2 = 0;  ///< radial distortion, in units of the focal length
  double p1 = 0, p2 = 0;  ///< tangential distortion
  double k3 = 0;          ///< third radial term, in OpenCV's order

  bool defined(const Eigen::Vector3d& point) const {
    return point.z() > 1e-9 && one_to_one(point.head<2>() / point.z());
  }

  template <class S>
  Vector2<S> h(const Vector3<S>& point) const {
    const Vector2<S> d = distort<S>({point.x() / point.z(), point.y() / point.z()});
    return {S(u0) + S(fu) * d.x(), S(v0) + S(fv) * d.y()};
  }

  Projection project(const Eigen::Vector3d& point) const {
    const double iz = 1 / point.z();
    const Eigen::Vector2d c = point.head<2>() * iz;
    Eigen::Matrix<double, 2, 3> flat;  // d(c)/d(point)
    flat << iz, 0, -c.x() * iz, 0, iz, -c.y() * iz;
    const Eigen::Vector2d d = distort<double>(c);
    return {Eigen::Vector2d(u0 + fu * d.x(), v0 + fv * d.y()),
            Eigen::Vector2d(fu, fv).asDiagonal() * distortion_jacobian(c) * flat};
  }

  /// Newton's method from the undistorted guess, restricted to the region where the distortion is one to one.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const {
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

  void check() const {
    const auto need = [](bool ok, const char* what, double value) {
      if (!ok) throw std::invalid_argument(std::string(what) + ", got " + std::to_string(value));
    };
    need(width >= 16, "camera width_px must be at least 16", width);
    need(height >= 16, "camera height_px must be at least 16", height);
    need(std::isfinite(fu) && fu > 0, "camera fu_px must be positive", fu);
    need(std::isfinite(fv) && fv > 0, "camera fv_px must be positive", fv);
    need(std::isfinite(u0) && u0 > 0 && u0 < width, "camera u0_px must lie inside the image width", u0);
    need(std::isfinite(v0) && v0 > 0 && v0 < height, "camera v0_px must lie inside the image height", v0);
    need(std::isfinite(k1), "camera k1 must be finite", k1);
    need(std::isfinite(k2), "camera k2 must be finite", k2);
    need(std::isfinite(p1), "camera p1 must be finite", p1);
    need(std::isfinite(p2), "camera p2 must be finite", p2);
    need(std::isfinite(k3), "camera k3 must be finite", k3);
  }

 private:
  template <class S>
  Vector2<S> distort(const Vector2<S>& c) const {
    const S x = c.x(), y = c.y(), s = x * x + y * y, xy = x * y;
    const S radial = S(1) + s * (S(k1) + s * (S(k2) + s * S(k3)));
    return {x * radial + S(2 * p1) * xy + S(p2) * (s + S(2) * x * x),
            y * radial + S(p1) * (s + S(2) * y * y) + S(2 * p2) * xy};
  }

  Eigen::Matrix2d distortion_jacobian(const Eigen::Vector2d& c) const {
    const double x = c.x(), y = c.y(), s = c.squaredNorm();
    const double radial = 1 + s * (k1 + s * (k2 + s * k3));
    const double slope = 2 * (k1 + s * (2 * k2 + s * 3 * k3));  // d(radial)/dx = slope x
    const double mixed = slope * x * y + 2 * p1 * x + 2 * p2 * y;
    Eigen::Matrix2d J;
    J << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, mixed,  //
        mixed, radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
    return J;
  }

  // avoids the include of Eigen/LU
  static double determinant(const Eigen::Matrix2d& J) { return J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0); }

  /// Whether the distortion is one to one from the optical axis to c. Beyond, the polynomial folds over and
  /// would project points outside the field of view into the image.
  bool one_to_one(const Eigen::Vector2d& c) const {
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

  /// Newton step, halved until the residual decreases within the one-to-one region.
  std::optional<Eigen::Vector2d> newton_step(const Eigen::Vector2d& c, const Eigen::Vector2d& wanted,
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
};

static_assert(CameraModel<PinholeCamera>);

}  // namespace incognita
