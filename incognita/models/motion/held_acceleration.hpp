// Free motion in space under held accelerations, integrated to second order. (5.24) uses the velocity at the
// end of the step, so its position is f dt^2 / 2 too far. The error is systematic and would bias a filter
// with accurate sensors: at 1 m/s^2 and 20 steps per second it is 1.25 mm, more than most noise.
//
// Here the velocities at the middle of the step are used. The position is exact, and so is the rotation about
// a fixed axis; for a rotating axis the error is of order dt^3.
#pragma once

#include "incognita/models/motion/free_camera.hpp"

namespace incognita {

struct HeldAcceleration {
  static constexpr int state_size = FreeCameraMotion::state_size;
  static constexpr int error_size = FreeCameraMotion::error_size;
  static constexpr int input_size = FreeCameraMotion::input_size;
  template <class S>
  using State = FreeCameraMotion::State<S>;
  template <class S>
  using Input = FreeCameraMotion::Input<S>;
  using Jacobian = FreeCameraMotion::Jacobian;
  using InputJacobian = FreeCameraMotion::InputJacobian;
  using Step = FreeCameraMotion::Step;
  static constexpr Chart chart = FreeCameraMotion::chart;

  FreeCameraMotion motion = {};  ///< the continuous motion model

  template <class S>
  State<S> rate(const State<S>& x, const Input<S>& u) const {
    return motion.rate<S>(x, u);
  }

  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const {
    State<S> y;
    const Vector3<S> v = x.template segment<3>(7) + u.template head<3>() * S(dt / 2);
    const Vector3<S> w = x.template segment<3>(10) + u.template tail<3>() * S(dt / 2);
    y.template segment<3>(0) = x.template segment<3>(0) + v * S(dt);
    const Vector4<S> turned =
        quaternion_product<S>(x.template segment<4>(3), quaternion_exp<S>(Vector3<S>(w * S(dt))));
    y.template segment<4>(3) = turned / turned.norm();
    y.template segment<6>(7) = x.template segment<6>(7) + u * S(dt);
    return y;
  }

  Step step(const State<double>& x, const Input<double>& u, double dt) const;
};

}  // namespace incognita
