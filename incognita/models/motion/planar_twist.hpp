// Planar motion with a velocity that is constant in the axes of the moving body, exactly: x times exp(u dt) in SE(2).
//
// With phi = w dt the displacement in body axes is dt (a S - c C, a C + c S), S = sin(phi) / phi, C = (1 - cos(phi)) / phi,
// where (a, c) is the velocity along and across the body: ArcTerms.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "incognita/models/motion/arc_motion.hpp"

namespace incognita {

/// Integrator, as filters use it. Input (3): velocity forward and to the left (m/s, body axes), turn rate (rad/s).
struct PlanarTwist {
  static constexpr int state_size = 3;
  static constexpr int error_size = 3;
  static constexpr int input_size = 3;
  template <class S>
  using State = planar::Pose<S>;
  template <class S>
  using Input = Eigen::Matrix<S, input_size, 1>;
  struct Step {
    State<double> x;    ///< pose after dt
    Eigen::Matrix3d F;  ///< d(error after) / d(error before)
    Eigen::Matrix3d G;  ///< d(error after) / d(input)
  };
  static constexpr Chart chart = planar::pose_chart;

  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    using std::cos, std::sin;
    const ArcTerms<S> arc(S(u[2] * S(dt)));
    const S dx = (u[0] * arc.s - u[1] * arc.c) * S(dt), dy = (u[0] * arc.c + u[1] * arc.s) * S(dt);
    const S cs = cos(x[2]), sn = sin(x[2]);
    return State<S>(x[0] + cs * dx - sn * dy, x[1] + sn * dx + cs * dy, wrap_angle<S>(x[2] + u[2] * S(dt)));
  }

  Step step(const State<double>& x, const Input<double>& u, double dt) const;
};

/// Velocity of a body, measured by itself and constant over `period_s`, with its own noise.
struct MeasuredTwist {
  Eigen::Vector3d twist{0, 0, 0};                 ///< input of PlanarTwist
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();  ///< of an error that is constant over the period
  double period_s = 0;
};

/// The twist that moves by `increment` (x, y in m and heading in rad, in the axes of the pose before) in `period_s`, and its
/// covariance from that of the increment. None for a turn of half a circle or more, and for a period that is not positive.
std::optional<MeasuredTwist> twist_of_increment(const planar::Pose<double>& increment,
                                                const Eigen::Matrix3d& cov, double period_s);

/// The same motion of another point of the body, `forward_m` ahead and `left_m` to the left.
MeasuredTwist twist_of_point(const MeasuredTwist& body, double forward_m, double left_m);

}  // namespace incognita
