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

  bool defined(const Eigen::Vector3d& point) const;

  template <class S>
  Vector2<S> h(const Vector3<S>& point) const {
    const Vector2<S> d = distort<S>({point.x() / point.z(), point.y() / point.z()});
    return {S(u0) + S(fu) * d.x(), S(v0) + S(fv) * d.y()};
  }

  Projection project(const Eigen::Vector3d& point) const;

  /// Newton's method from the undistorted guess, restricted to the region where the distortion is one to one.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  void check() const;

 private:
  template <class S>
  Vector2<S> distort(const Vector2<S>& c) const {
    const S x = c.x(), y = c.y(), s = x * x + y * y, xy = x * y;
    const S radial = S(1) + s * (S(k1) + s * (S(k2) + s * S(k3)));
    return {x * radial + S(2 * p1) * xy + S(p2) * (s + S(2) * x * x),
            y * radial + S(p1) * (s + S(2) * y * y) + S(2 * p2) * xy};
  }

  Eigen::Matrix2d distortion_jacobian(const Eigen::Vector2d& c) const;

  static double determinant(const Eigen::Matrix2d& J);

  /// Whether the distortion is one to one from the optical axis to c. Beyond, the polynomial folds over and
  /// would project points outside the field of view into the image.
  bool one_to_one(const Eigen::Vector2d& c) const;

  /// Newton step, halved until the residual decreases within the one-to-one region.
  std::optional<Eigen::Vector2d> newton_step(const Eigen::Vector2d& c, const Eigen::Vector2d& wanted,
                                             const Eigen::Vector2d& missing) const;
};

static_assert(CameraModel<PinholeCamera>);

}  // namespace incognita
