// A body that moves freely in space under accelerations that are held, as commands are: what a filter needs
// that is to be as good as its sensors. (5.24) moves it with the velocity of the step's end, which is f dt^2
// / 2 too far, always to the same side; at 1 m/s^2 and 20 steps a second that is 1.25 mm and more than most
// noise.
//
// Here it moves, and turns, with the velocities of the step's middle. For the position that is exact. So it
// is for a turn about an axis that stays; of others it misses the third power of dt, as the axis turns.
#pragma once

#include "incognita/models/free_camera.hpp"

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

  FreeCameraMotion motion = {};  ///< what it integrates

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

  Step step(const State<double>& x, const Input<double>& u, double dt) const {
    Step s{f<double>(x, u, dt), Jacobian::Identity(), InputJacobian::Zero()};
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d turn = (x.segment<3>(10) + u.tail<3>() * dt / 2) * dt;
    const Eigen::Matrix3d J = right_jacobian(turn);
    s.F.block<3, 3>(0, 6) = dt * I;
    s.F.block<3, 3>(3, 3) = rotation_exp<double>(-turn);
    s.F.block<3, 3>(3, 9) = dt * J;
    s.G.block<3, 3>(0, 0) = dt * dt / 2 * I;
    s.G.block<3, 3>(3, 3) = dt * dt / 2 * J;
    s.G.block<3, 3>(6, 0) = dt * I;
    s.G.block<3, 3>(9, 3) = dt * I;
    return s;
  }
};

}  // namespace incognita
