// Wide-angle camera with one radial distortion term: thesis (5.26), (5.27); the model of Swaminathan and
// Nayar as used by MonoSLAM.
//
//   u_c = fu x/z,  v_c = fv y/z,  d = 1 + 2 kd1 (u_c^2 + v_c^2),  u = u0 + u_c / sqrt(d)
//
// The thesis' K_d is 2 kd1, and its minus signs belong to an x-left, y-up camera; here x is right and y down.
#pragma once

#include <cmath>
#include <string>

#include "incognita/models/sensors/camera.hpp"

namespace incognita {

struct WideAngleCamera {
  int width = 320;
  int height = 240;
  double fu = 195;    ///< focal length over pixel width, px
  double fv = 195;    ///< focal length over pixel height, px
  double u0 = 159.5;  ///< principal point, px
  double v0 = 119.5;
  double kd1 = 0;  ///< radial distortion, px^-2, >= 0

  bool defined(const Eigen::Vector3d& point) const { return point.z() > 1e-9; }

  template <class S>
  Vector2<S> h(const Vector3<S>& point) const {
    using std::sqrt;
    const S uc = S(fu) * point.x() / point.z(), vc = S(fv) * point.y() / point.z();
    const S root_d = sqrt(S(1) + S(2 * kd1) * (uc * uc + vc * vc));
    return {S(u0) + uc / root_d, S(v0) + vc / root_d};
  }

  Projection project(const Eigen::Vector3d& point) const;

  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  void check() const;
};

static_assert(CameraModel<WideAngleCamera>);

}  // namespace incognita
