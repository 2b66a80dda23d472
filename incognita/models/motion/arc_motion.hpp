// Planar vehicles that follow the exact arc of a held input instead of its tangent (3.16). The difference,
// speed times turn over 2 per step, is systematic, to the outside of the curve, and would bias a filter with
// accurate sensors.
//
// With phi = w dt the displacement of the point in body axes is dt (a S - c C, a C + c S), S = sin(phi) /
// phi, C = (1 - cos(phi)) / phi, where (a, c) is the point's velocity along and across the body. The motion
// is invariant to the initial pose, so F is jacobian_between().
#pragma once

#include <cmath>

#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

/// S and C of the file comment and their derivatives with respect to the angle.
template <class S>
struct ArcTerms {
  S s, c, ds, dc;
  explicit ArcTerms(const S& phi) {
    using std::cos, std::sin;
    if (phi * phi < S(1e-6)) {
      s = S(1) - phi * phi / S(6), c = phi / S(2) - phi * phi * phi / S(24);
      ds = -phi / S(3) + phi * phi * phi / S(30), dc = S(0.5) - phi * phi / S(8);
      return;
    }
    s = sin(phi) / phi, c = (S(1) - cos(phi)) / phi;
    ds = (cos(phi) - s) / phi, dc = (sin(phi) - c) / phi;
  }
};

template <class Vehicle>
struct ArcMotion {
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
  static constexpr Chart chart = planar::pose_chart;

  Vehicle vehicle;

  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    using std::cos, std::sin;
    const Input<S> axle = vehicle.template at_axle<S>(u);
    const S along = axle[0] - axle[1] * S(vehicle.point().left_m),
            across = axle[1] * S(vehicle.point().forward_m);
    const ArcTerms<S> arc(S(axle[1] * S(dt)));
    const S dx = (along * arc.s - across * arc.c) * S(dt), dy = (along * arc.c + across * arc.s) * S(dt);
    const S cs = cos(x[2]), sn = sin(x[2]);
    return State<S>(x[0] + cs * dx - sn * dy, x[1] + sn * dx + cs * dy,
                    wrap_angle<S>(x[2] + axle[1] * S(dt)));
  }

  template <class S>
  State<S> rate(const State<S>& x, const Input<S>& u) const {
    return vehicle.template rate<S>(x, u);
  }

  Step step(const State<double>& x, const Input<double>& u, double dt) const {
    const Input<double> axle = vehicle.template at_axle<double>(u);
    const double l = vehicle.point().forward_m, b = vehicle.point().left_m;
    const double along = axle[0] - axle[1] * b, across = axle[1] * l;
    const ArcTerms<double> arc(axle[1] * dt);
    const Eigen::Vector2d by_speed(arc.s, arc.c), by_turn(-b * arc.s - l * arc.c, -b * arc.c + l * arc.s),
        by_bend(along * arc.ds - across * arc.dc, along * arc.dc + across * arc.ds);
    const Eigen::Matrix2d R = planar::rotation(x[2]);
    Step step{f<double>(x, u, dt), Jacobian::Identity(), InputJacobian::Zero()};
    step.F(0, 2) = -(step.x[1] - x[1]);
    step.F(1, 2) = step.x[0] - x[0];
    step.G.topLeftCorner<2, 1>() = R * by_speed * dt;
    step.G.topRightCorner<2, 1>() = R * (by_turn + by_bend * dt) * dt;
    step.G(2, 1) = dt;
    step.G = (step.G * vehicle.axle_by_input(u)).eval();
    return step;
  }
};

}  // namespace incognita
