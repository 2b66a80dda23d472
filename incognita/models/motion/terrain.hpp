// Uneven ground as a height over the plane, z = h(x, y) in the world (m, z up), with exact derivatives.
//
// A vehicle on the ground rotates with the second derivatives of h, and the Jacobians of its motion need the third,
// so each surface provides derivatives up to third order. All functions are templates on the scalar type.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "incognita/math/quaternion.hpp"

namespace incognita {

/// Height of the ground (m) with its derivatives: m/m, 1/m, 1/m^2.
template <class S>
struct GroundPoint {
  S height = S(0);
  S x = S(0), y = S(0);  ///< gradient
  S xx = S(0), xy = S(0), yy = S(0);
  S xxx = S(0), xxy = S(0), xyy = S(0), yyy = S(0);
};

/// A plane, level by default.
struct TiltedPlane {
  double height_m = 0;  ///< at x = y = 0
  double slope_x = 0;   ///< m up per m along x
  double slope_y = 0;

  template <class S>
  GroundPoint<S> at(const S& x, const S& y) const {
    GroundPoint<S> p;
    p.height = S(height_m) + S(slope_x) * x + S(slope_y) * y;
    p.x = S(slope_x);
    p.y = S(slope_y);
    return p;
  }
  bool contains(double, double) const { return true; }
  void check() const;
};

/// Sinusoidal ground (thesis Section 6.4.2): a sum of plane waves in any direction. Two perpendicular waves
/// make hills and hollows.
struct Waves {
  struct Wave {
    double amplitude_m = 0.2;
    double length_m = 4;       ///< wavelength
    double direction_rad = 0;  ///< of propagation, about z from +x
    double phase_rad = 0;      ///< at x = y = 0; of a sine
  };
  double height_m = 0;  ///< mean height
  std::vector<Wave> waves;

  template <class S>
  GroundPoint<S> at(const S& x, const S& y) const;
  bool contains(double, double) const { return true; }
  void check() const;
};

/// Heights on a square grid, interpolated by the natural bicubic spline: it passes through every height, its
/// derivatives up to second order are continuous, the third ones jump between cells. Beyond the border the
/// ground is extrapolated linearly.
class HeightMap {
 public:
  /// `heights_m`(i, j) is the height at x = origin.x() + i spacing_m, y = origin.y() + j spacing_m. Throws
  /// std::invalid_argument for fewer than 2 heights in either direction, a spacing that is not positive, and
  /// values that are not finite.
  HeightMap(const Eigen::MatrixXd& heights_m, double spacing_m,
            const Eigen::Vector2d& origin_m = Eigen::Vector2d::Zero());

  template <class S>
  GroundPoint<S> at(const S& x, const S& y) const;

  /// Whether the position is inside the grid.
  bool contains(double x, double y) const;

  void check() const {}  // done by the constructor

 private:
  /// The four B-splines that are nonzero on a cell, with their derivatives.
  template <class S>
  struct Weights {
    int first;                 ///< index of the coefficient of w[.][0]
    Eigen::Matrix<S, 4, 4> w;  ///< row: order of the derivative
  };

  /// `u`: position in cells from the first height. `cells`: number of cells.
  template <class S>
  static Weights<S> weights(const S& u, int cells);

  Eigen::MatrixXd coefficients_;  ///< of uniform cubic B-splines, one more than the heights on each side
  double spacing_m_;
  Eigen::Vector2d origin_m_;
};

/// Any of these surfaces, by value.
class Terrain {
 public:
  Terrain() = default;  ///< level ground at height 0

  /// Throws std::invalid_argument, naming the invalid parameter.
  template <class Surface>
  requires(!std::is_same_v<std::remove_cvref_t<Surface>, Terrain>) Terrain(Surface surface)
      : surface_(std::move(surface)) {  // NOLINT(google-explicit-constructor): a holder
    std::visit([](const auto& held) { held.check(); }, surface_);
  }

  template <class S>
  GroundPoint<S> at(const S& x, const S& y) const {
    return std::visit([&](const auto& surface) { return surface.template at<S>(x, y); }, surface_);
  }

  /// Whether the height is defined by data; beyond the border of a height map it is extrapolated.
  bool contains(double x, double y) const {
    return std::visit([&](const auto& surface) { return surface.contains(x, y); }, surface_);
  }

 private:
  std::variant<TiltedPlane, Waves, HeightMap> surface_;
};

template <class S>
GroundPoint<S> Waves::at(const S& x, const S& y) const {
  using std::cos, std::sin;
  GroundPoint<S> p;
  p.height = S(height_m);
  for (const Wave& wave : waves) {
    const double k = 2 * std::numbers::pi / wave.length_m;
    const double kx = k * std::cos(wave.direction_rad), ky = k * std::sin(wave.direction_rad);
    const S at = S(kx) * x + S(ky) * y + S(wave.phase_rad);
    const S up = S(wave.amplitude_m) * sin(at), steep = S(wave.amplitude_m) * cos(at);
    p.height += up;
    p.x += S(kx) * steep;
    p.y += S(ky) * steep;
    p.xx -= S(kx * kx) * up;
    p.xy -= S(kx * ky) * up;
    p.yy -= S(ky * ky) * up;
    p.xxx -= S(kx * kx * kx) * steep;
    p.xxy -= S(kx * kx * ky) * steep;
    p.xyy -= S(kx * ky * ky) * steep;
    p.yyy -= S(ky * ky * ky) * steep;
  }
  return p;
}

template <class S>
HeightMap::Weights<S> HeightMap::weights(const S& u, int cells) {
  // Bisection, because a scalar type need not convert to int; positions beyond the border use the last cell
  int cell = 0;
  for (int above = cells; above - cell > 1;) {
    const int middle = (cell + above) / 2;
    (u < S(middle) ? above : cell) = middle;
  }
  const S t = u - S(cell);
  const bool beyond = t < S(0) || t > S(1);
  const double edge = t < S(0) ? 0 : 1;
  const S in = beyond ? S(edge) : t, out = S(1) - in;
  Weights<S> weights{cell, {}};
  weights.w << out * out * out, S(4) + in * in * (S(3) * in - S(6)), S(4) + out * out * (S(3) * out - S(6)),
      in * in * in,                                                                             //
      S(-3) * out * out, in * (S(9) * in - S(12)), out * (S(12) - S(9) * out), S(3) * in * in,  //
      S(6) * out, S(18) * in - S(12), S(18) * out - S(12), S(6) * in,                           //
      S(-6), S(18), S(-18), S(6);
  weights.w *= S(1.0 / 6);
  if (beyond) {  // A natural spline has no curvature at its border, so the extrapolation is C2
    weights.w.row(0) += (t - in) * weights.w.row(1);
    weights.w.template bottomRows<2>().setZero();
  }
  return weights;
}

template <class S>
GroundPoint<S> HeightMap::at(const S& x, const S& y) const {
  const double per_m = 1 / spacing_m_;
  const auto wx = weights<S>((x - S(origin_m_.x())) * S(per_m), static_cast<int>(coefficients_.rows()) - 3);
  const auto wy = weights<S>((y - S(origin_m_.y())) * S(per_m), static_cast<int>(coefficients_.cols()) - 3);
  const Eigen::Matrix<S, 4, 4> c = coefficients_.block<4, 4>(wx.first, wy.first).template cast<S>();
  const Eigen::Matrix<S, 4, 4> d =
      wx.w * c * wy.w.transpose();  // (a, b): orders of the derivatives by x and y, in cells
  const S k1(per_m), k2(per_m * per_m), k3(per_m * per_m * per_m);
  return {d(0, 0),      k1 * d(1, 0), k1 * d(0, 1), k2 * d(2, 0), k2 * d(1, 1),
          k2 * d(0, 2), k3 * d(3, 0), k3 * d(2, 1), k3 * d(1, 2), k3 * d(0, 3)};
}

}  // namespace incognita
