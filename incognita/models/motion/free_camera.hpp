// A body that moves freely in space with nearly constant velocity: thesis (5.24).
//
// State (13): position p (m, world), orientation q = world_from_camera (w,x,y,z), velocity v (m/s, world),
// angular rate w (rad/s, camera axes). Error (12): position, right rotation error, velocity, angular rate.
// Input (6): linear acceleration f (m/s^2, world), angular acceleration a (rad/s^2, camera axes). (5.24)
// rotates with the rate at the start of the step; here the rate at its end is used, as for the position.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "incognita/math/chart.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/models/motion/motion_model.hpp"

namespace incognita {

struct HeldAcceleration;  ///< the integrator of FreeCameraMotion: held_acceleration.hpp

struct FreeCameraMotion {
  static constexpr int state_size = 13;
  static constexpr int error_size = 12;
  static constexpr int input_size = 6;
  template <class S>
  using State = Eigen::Matrix<S, state_size, 1>;
  template <class S>
  using Input = Eigen::Matrix<S, input_size, 1>;
  using Jacobian = Eigen::Matrix<double, error_size, error_size>;
  using InputJacobian = Eigen::Matrix<double, error_size, input_size>;

  static constexpr std::string_view name = "free-camera";
  static constexpr std::string_view summary = "a camera that moves freely in space, driven by accelerations";
  static constexpr Space space = Space::space;
  static constexpr int position_size = 3;
  static constexpr std::array<Quantity, state_size> state{{{"x", "m"},
                                                           {"y", "m"},
                                                           {"z", "m"},
                                                           {"qw", ""},
                                                           {"qx", ""},
                                                           {"qy", ""},
                                                           {"qz", ""},
                                                           {"vx", "m/s"},
                                                           {"vy", "m/s"},
                                                           {"vz", "m/s"},
                                                           {"wx", "rad/s"},
                                                           {"wy", "rad/s"},
                                                           {"wz", "rad/s"}}};
  static constexpr std::array<Quantity, error_size> error{{{"x", "m", "position"},
                                                           {"y", "m", "position"},
                                                           {"z", "m", "height"},
                                                           {"rotX", "rad", "heading"},
                                                           {"rotY", "rad", "heading"},
                                                           {"rotZ", "rad", "heading"},
                                                           {"vx", "m/s", "velocity"},
                                                           {"vy", "m/s", "velocity"},
                                                           {"vz", "m/s", "velocity"},
                                                           {"wx", "rad/s", "angular_rate"},
                                                           {"wy", "rad/s", "angular_rate"},
                                                           {"wz", "rad/s", "angular_rate"}}};
  static constexpr std::array<Quantity, input_size> input{{{"ax", "m/s^2", "acceleration"},
                                                           {"ay", "m/s^2", "acceleration"},
                                                           {"az", "m/s^2", "acceleration"},
                                                           {"alphax", "rad/s^2", "angular_acceleration"},
                                                           {"alphay", "rad/s^2", "angular_acceleration"},
                                                           {"alphaz", "rad/s^2", "angular_acceleration"}}};
  static constexpr Chart chart{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}, {Chart::Kind::line, 6}};
  using Integrator = HeldAcceleration;

  struct Step {
    State<double> x;  ///< state after dt
    Jacobian F;       ///< d(error after) / d(error before)
    InputJacobian G;  ///< d(error after) / d(input), also for acceleration noise
  };

  /// d(state)/dt (13): p' = v, q' = 1/2 q (0, w), v' = f, w' = a, the continuous form of (5.24). The
  /// integrator has to normalize q.
  template <class S>
  State<S> rate(const State<S>& x, const Input<S>& u) const;

  /// One step of dt seconds with the input held. Linear and angular parts are decoupled.
  template <class S>
  State<S> f(const State<S>& x, const Input<S>& u, double dt) const;

  Step step(const State<double>& x, const Input<double>& u, double dt) const;

  PoseOf<error_size> pose(const State<double>& x) const;
  /// Heading of the optical axis.
  double heading(const State<double>& x) const;
  /// The camera is level.
  static State<double> at_rest(const Eigen::Vector3d& position, double heading);
};

/// Accessors to the parts of a free camera's state.
namespace free_camera {
template <class V>
auto position(V&& x) {
  return x.template segment<3>(0);
}
template <class V>
auto orientation(V&& x) {
  return x.template segment<4>(3);
}
template <class V>
auto velocity(V&& x) {
  return x.template segment<3>(7);
}
template <class V>
auto angular_rate(V&& x) {
  return x.template segment<3>(10);
}
}  // namespace free_camera

template <class S>
FreeCameraMotion::State<S> FreeCameraMotion::rate(const State<S>& x, const Input<S>& u) const {
  State<S> d;
  const Vector3<S> w = x.template segment<3>(10);
  d.template segment<3>(0) = x.template segment<3>(7);
  d.template segment<4>(3) =
      S(0.5) * quaternion_product<S>(x.template segment<4>(3), Vector4<S>(S(0), w.x(), w.y(), w.z()));
  d.template segment<6>(7) = u;
  return d;
}

template <class S>
FreeCameraMotion::State<S> FreeCameraMotion::f(const State<S>& x, const Input<S>& u, double dt) const {
  State<S> y;
  const Vector3<S> v = x.template segment<3>(7) + u.template head<3>() * S(dt);
  const Vector3<S> w = x.template segment<3>(10) + u.template tail<3>() * S(dt);
  y.template segment<3>(0) = x.template segment<3>(0) + v * S(dt);
  const Vector4<S> turned =
      quaternion_product<S>(x.template segment<4>(3), quaternion_exp<S>(Vector3<S>(w * S(dt))));
  y.template segment<4>(3) = turned / turned.norm();
  y.template segment<3>(7) = v;
  y.template segment<3>(10) = w;
  return y;
}

}  // namespace incognita
