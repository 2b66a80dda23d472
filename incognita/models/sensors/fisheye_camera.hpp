// Fisheye camera of Kannala and Brandt (PAMI 2006) with four terms, as OpenCV's fisheye module and Kalibr's `equidistant`.
//
//   theta = angle between ray and optical axis, theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
//   u = u0 + fu theta_d x / |(x, y)|,  v = v0 + fv theta_d y / |(x, y)|
//
// Rays here are (x, y, 1), so the model is defined in front of the camera only, up to 1 mrad before 90 degrees.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "incognita/models/sensors/camera.hpp"

namespace incognita {

struct FisheyeCamera {
  int width = 320;
  int height = 240;
  double fu = 195;    ///< focal length over pixel width, px
  double fv = 195;    ///< focal length over pixel height, px
  double u0 = 159.5;  ///< principal point, px
  double v0 = 119.5;
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0;  ///< distortion, in powers of rad; all 0: equidistant

  bool defined(const Eigen::Vector3d& point) const;

  template <class S>
  Vector2<S> h(const Vector3<S>& point) const {
    const Vector2<S> c(point.x() / point.z(), point.y() / point.z());
    const S ratio = distortion_ratio<S>(c.squaredNorm());
    return {S(u0) + S(fu) * c.x() * ratio, S(v0) + S(fv) * c.y() * ratio};
  }

  Projection project(const Eigen::Vector3d& point) const;

  /// Newton's method, bracketed by bisection, where theta_d rises with theta.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  void check() const;

 private:
  static constexpr double largest_angle = 1.5707963267948966 - 1e-3;
  static constexpr double near_axis = 1e-6;  ///< squared tangent below which series replace quotients

  template <class S>
  S polynomial(const S& t) const {  // theta_d / theta, t = theta^2
    return S(1) + t * (S(k1) + t * (S(k2) + t * (S(k3) + t * S(k4))));
  }
  double distorted(double theta) const { return theta * polynomial(theta * theta); }
  /// d(theta_d) / d(theta)
  double slope(double t) const { return 1 + t * (3 * k1 + t * (5 * k2 + t * (7 * k3 + t * 9 * k4))); }

  /// theta_d / tan(theta) by s = tan(theta)^2; smooth at the axis.
  template <class S>
  S distortion_ratio(const S& s) const {
    using std::atan2;
    using std::sqrt;
    if (s < S(near_axis)) {
      const S ratio = S(1) - s * (S(1.0 / 3) - s * S(0.2));  // theta / tan(theta), to 1e-19
      return ratio * polynomial<S>(S(s * ratio * ratio));
    }
    const S tangent = sqrt(s), theta = atan2(tangent, S(1));
    return theta * polynomial<S>(S(theta * theta)) / tangent;
  }

  /// d(distortion_ratio) / ds
  double ratio_slope(double s) const;

  /// Whether theta_d rises with theta from the axis up to theta^2 = t. The slope is a polynomial of degree 4: it is
  /// positive where its Bernstein coefficients are, and otherwise the interval is halved.
  bool rises_up_to(double t) const;

  using Bernstein = std::array<double, 5>;
  static bool is_positive(const Bernstein& b, int halvings);

  /// The largest angle up to which theta_d rises.
  double end_of_rise() const;
};

static_assert(CameraModel<FisheyeCamera>);

}  // namespace incognita
