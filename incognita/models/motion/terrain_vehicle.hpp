// A vehicle with two driven wheels on uneven ground: thesis Section 6.4.1, derived from the contact constraint.
//
// State (3): position x, y of the middle of its axle in the world (m) and heading (rad). Its height is that
// of the ground, its z axis (up) the normal of the ground, and its heading that of the horizontal projection
// of its x axis (forward), about z from +x. This heading needs no frame on the ground, agrees with that of a
// compass and of a planar vehicle, and has no singularity, since a height function is nowhere vertical. Input
// (2): speed along the ground (m/s) and turn rate about the normal of the ground (rad/s).
//
// With the horizontal forward direction (c, s) = (cos heading, sin heading), the slope of the ground along
// it, m = c h_x + s h_y, and across it, k = c h_y - s h_x, its second derivative along it, b = c^2 h_xx + 2 c
// s h_xy + s^2 h_yy, L^2 = 1 + m^2 and N^2 = 1 + h_x^2 + h_y^2, the body's axes are
//   t = (c, s, m) / L (forward),  n = (-h_x, -h_y, 1) / N (up),  n x t (left),
// motion along t with speed v gives x' = v c / L, y' = v s / L, and t' . (n x t) = w gives
//   heading' = w L^2 / N - v b k / (N^2 L).
// On level ground this is the rate of DifferentialDrive. `rate` computes it; `f` is a classical fourth-order
// Runge-Kutta step with the input held: its local error is of order dt^5 and it stays on the ground exactly.
// A long step is split, so that the ground in between is sampled.
//
// Comparison with (6.10), which moves the optical center, l ahead of the axle. With the camera axes (x right, y down,
// z forward) in the columns of Rz(phi) Ry(-theta) Rx(-psi) it reads p' = v z - w l cos(psi) x, and the camera rotates
// with w about -y. In these angles this is correct on any plane, level or tilted, except for cos(psi): a rigid lever
// gives w l x. In a world with z up a level camera has cos(psi) = 0 and its lever would have no effect; with y up, as
// in the thesis, cos(psi) is 1 or -1, depending on the branch of the angles. On curved ground (6.10) lacks the
// rotation due to translation: the vehicle pitches and rolls by v times the curvatures of the ground, where the first
// column has only zeros, so the integrated pose leaves the ground at once. Its terms tan(theta) and 1/cos(theta) are
// singular at headings that are reached twice in every full turn.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/motion/rigid_pose.hpp"
#include "incognita/models/motion/terrain.hpp"

namespace incognita {

struct TerrainVehicle {
  static constexpr int state_size = 3;
  static constexpr int error_size = 3;
  static constexpr int input_size = 2;
  template <class S>
  using State = planar::Pose<S>;
  template <class S>
  using Input = Eigen::Matrix<S, input_size, 1>;
  using Jacobian = planar::PoseJacobian;
  using InputJacobian = planar::PoseInputJacobian;
  using Step = planar::Step;
  static constexpr std::string_view name = "terrain";
  static constexpr std::string_view summary = "two driven wheels that follow uneven ground";
  static constexpr Space space = Space::uneven_ground;
  static constexpr int position_size = 2;
  static constexpr auto state = planar::pose_quantities, error = state;
  static constexpr auto input = planar::drive_quantities;
  static constexpr Chart chart = planar::pose_chart;
  using Integrator = TerrainVehicle;

  Terrain terrain;
  /// A step is split into equal pieces, none of which exceeds these limits.
  double longest_piece_m = 0.25;
  double longest_piece_rad = 0.25;
  static constexpr int most_pieces = 1000;  ///< upper limit for any input

  /// The ground under the vehicle along its heading, in the symbols of the file comment.
  template <class S>
  struct Contact {
    GroundPoint<S> ground;
    S c, s, m, k, b, L, N;
  };

  template <class S>
  Contact<S> contact(const State<S>& x) const;

  /// d(x, y, heading)/dt: m/s, m/s, rad/s.
  template <class S>
  State<S> rate(const State<S>& x, const Input<S>& u) const;

  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const;

  Step step(const State<double>& x, const Input<double>& u, double dt) const;

  /// Number of pieces of a step.
  template <class S>
  int pieces(const Input<S>& u, double dt) const;

  /// One piece of f.
  template <class S>
  State<S> runge_kutta(const State<S>& x, const Input<S>& u, double dt) const;

  /// Middle of the axle, on the ground, m.
  template <class S>
  Vector3<S> position(const State<S>& x) const {
    return {x[0], x[1], terrain.at<S>(x[0], x[1]).height};
  }

  /// Columns: forward, left and up axes of the body in the world.
  template <class S>
  Matrix3<S> axes(const State<S>& x) const;

  PoseOf<error_size> pose(const State<double>& x) const;
  double heading(const State<double>& x) const { return x[2]; }
  static State<double> at_rest(const Eigen::Vector3d& position, double heading) {
    return {position.x(), position.y(), heading};
  }
};

template <class S>
TerrainVehicle::Contact<S> TerrainVehicle::contact(const State<S>& x) const {
  using std::cos, std::sin, std::sqrt;
  const GroundPoint<S> g = terrain.at<S>(x[0], x[1]);
  const S c = cos(x[2]), s = sin(x[2]);
  const S m = c * g.x + s * g.y, k = c * g.y - s * g.x;
  const S b = c * c * g.xx + S(2) * c * s * g.xy + s * s * g.yy;
  return {g, c, s, m, k, b, sqrt(S(1) + m * m), sqrt(S(1) + g.x * g.x + g.y * g.y)};
}

template <class S>
TerrainVehicle::State<S> TerrainVehicle::rate(const State<S>& x, const Input<S>& u) const {
  const Contact<S> on = contact<S>(x);
  return State<S>(u[0] * on.c / on.L, u[0] * on.s / on.L,
                  u[1] * on.L * on.L / on.N - u[0] * on.b * on.k / (on.N * on.N * on.L));
}

template <class S>
int TerrainVehicle::pieces(const Input<S>& u, double dt) const {
  using std::abs;
  const S way = abs(u[0]) * S(std::abs(dt) / longest_piece_m);
  const S turn = abs(u[1]) * S(std::abs(dt) / longest_piece_rad);
  int n = 1;
  while (n < most_pieces && (way > S(n) || turn > S(n))) ++n;
  return n;
}

template <class S>
TerrainVehicle::State<S> TerrainVehicle::f(const State<S>& x, const Input<S>& u, double dt) const {
  const int n = pieces<S>(u, dt);
  State<S> y = x;
  for (int i = 0; i < n; ++i) y = runge_kutta<S>(y, u, dt / n);
  return y;
}

template <class S>
TerrainVehicle::State<S> TerrainVehicle::runge_kutta(const State<S>& x, const Input<S>& u, double dt) const {
  const S h(dt), half(dt / 2);
  const State<S> r1 = rate<S>(x, u);
  const State<S> r2 = rate<S>(State<S>(x + half * r1), u);
  const State<S> r3 = rate<S>(State<S>(x + half * r2), u);
  const State<S> r4 = rate<S>(State<S>(x + h * r3), u);
  State<S> y = x + S(dt / 6) * (r1 + S(2) * r2 + S(2) * r3 + r4);
  y[2] = wrap_angle<S>(y[2]);
  return y;
}

template <class S>
Matrix3<S> TerrainVehicle::axes(const State<S>& x) const {
  const Contact<S> on = contact<S>(x);
  const GroundPoint<S>& g = on.ground;
  Matrix3<S> R;
  R.col(0) << on.c / on.L, on.s / on.L, on.m / on.L;
  R.col(1) << (-on.s - g.y * on.m) / (on.N * on.L), (on.c + g.x * on.m) / (on.N * on.L), on.k / (on.N * on.L);
  R.col(2) << -g.x / on.N, -g.y / on.N, S(1) / on.N;
  return R;
}

}  // namespace incognita
