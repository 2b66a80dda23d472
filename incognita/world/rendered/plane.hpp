// Ray-plane intersection of the room's surfaces: the part of the texture that each pixel covers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "incognita/world/rendered/room.hpp"

namespace incognita {

/// The two in-plane axes of a surface by its normal axis, in rising order.
inline constexpr std::array<int, 3> across_of{1, 0, 0}, down_of{2, 2, 1};

/// Texture area covered by each pixel of a row, in texels: squares of side `face_on`, stretched by (du, dv)
/// at glancing angles. A structure of arrays, so that the compiler can vectorize.
template <int count>
struct Covered {
  std::array<float, count> u, v, du, dv, face_on;
};

/// A plane rectangle relative to the camera: all quantities of a surface that are the same for all rays.
class Plane {
 public:
  Plane(const RoomSurface& surface, int axis, float distance, const Eigen::Vector3d& position)
      : axis_(axis), a_(across_of[axis]), b_(down_of[axis]), distance_(distance) {
    u_per_m_ = surface.u_per_m;
    v_per_m_ = surface.v_per_m;
    u_at_camera_ = surface.u_per_m * static_cast<float>(position[a_]) + surface.u_at_0;
    v_at_camera_ = surface.v_per_m * static_cast<float>(position[b_]) + surface.v_at_0;
  }

  template <int count>
  Covered<count> covered(const std::array<float, 9>& world_from_camera, const float* x, const float* y,
                         const float* footprint) const {
    const float* r = world_from_camera.data();
    const float *rn = r + 3 * axis_, *ra = r + 3 * a_, *rb = r + 3 * b_;
    Covered<count> c;
    for (int i = 0; i < count; ++i) {
      const float dn = rn[0] * x[i] + rn[1] * y[i] + rn[2];
      const float across = (ra[0] * x[i] + ra[1] * y[i] + ra[2]) * u_per_m_;
      const float down = (rb[0] * x[i] + rb[1] * y[i] + rb[2]) * v_per_m_;
      const float t = distance_ / dn, footprint_m = t * footprint[i], stretch = footprint_m / dn;
      c.u[i] = bounded(u_at_camera_ + t * across);
      c.v[i] = bounded(v_at_camera_ + t * down);
      c.du[i] = bounded(stretch * across);
      c.dv[i] = bounded(stretch * down);
      c.face_on[i] = footprint_m * std::abs(v_per_m_);
    }
    return c;
  }

 private:
  /// Clamps far outside of any texture, but small enough for fixed-point texel coordinates.
  static float bounded(float texels) { return std::min(std::max(texels, -1e5f), 1e5f); }

  int axis_, a_, b_;
  float distance_;  ///< signed, along the axis
  float u_per_m_, v_per_m_, u_at_camera_, v_at_camera_;
};

/// One to four texture samples along the area covered by pixel `i`.
template <int count>
inline int sample(const Texture& texture, const Covered<count>& c, int i) {
  const int u = static_cast<int>(c.u[i] * 256), v = static_cast<int>(c.v[i] * 256);
  const float stretch = c.du[i] * c.du[i] + c.dv[i] * c.dv[i], face_on = c.face_on[i];
  if (stretch <= std::max(face_on * face_on, 0.5f)) return texture.sample(u, v, face_on);
  const int du = static_cast<int>(c.du[i] * 256), dv = static_cast<int>(c.dv[i] * 256);
  if (stretch <= std::max(9 * face_on * face_on, 2.0f)) {
    const float each = std::max(face_on, 0.5f * std::sqrt(stretch));
    return (texture.sample(u - du / 4, v - dv / 4, each) + texture.sample(u + du / 4, v + dv / 4, each)) / 2;
  }
  const float each = std::max(face_on, 0.25f * std::sqrt(stretch));
  int sum = 0;
  for (int eighths = -3; eighths <= 3; eighths += 2)
    sum += texture.sample(u + du * eighths / 8, v + dv * eighths / 8, each);
  return sum / 4;
}

}  // namespace incognita
