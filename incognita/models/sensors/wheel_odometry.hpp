// Wheel odometry as a measurement of the state of a mounted camera.
//
// A vehicle that neither lifts off nor slides moves along its forward axis and rotates about its up axis at
// the measured rates. With the constant lever l of the camera and C = body_from_camera, the axle moves with
//   C R' v + l x C w = (speed, 0, 0),   and   (C w)_z = turn rate,
// v and R the camera's velocity and orientation in the world, w its rate in its own axes. The zeros are
// nonholonomic constraints, as informative as the speed. The rotation of the body about its other axes, due
// to the ground, is not measured.
#pragma once

#include <Eigen/Core>

#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/motion/mount.hpp"

namespace incognita {

struct WheelOdometry {
  static constexpr int size = 4;

  Mount mount;
  double sigma_speed_m_s = 0.05;        ///< of the wheel speed, per reading
  double sigma_turn_rate_rad_s = 0.02;  ///< of the turn rate
  double sigma_slip_m_s = 0.02;         ///< deviation from the no-slip constraint, per axis, at the axle

  template <class S>
  using Measured = Eigen::Matrix<S, size, 1>;

  /// Velocity of the axle, forward, left and up (m/s), and turn rate (rad/s). The wheels' (speed, turn rate)
  /// are the measurement (speed, 0, 0, turn rate).
  template <class S>
  Measured<S> h(const FreeCameraMotion::State<S>& camera) const {
    const Matrix3<S> body_from_camera = mount.body_from_camera().cast<S>();
    const Vector3<S> lever = mount.lever().cast<S>();
    const Vector4<S> q = camera.template segment<4>(3);
    const Vector3<S> w = body_from_camera * camera.template segment<3>(10);
    const Vector3<S> v =
        body_from_camera * (rotation_matrix<S>(q).transpose() * camera.template segment<3>(7));
    Measured<S> z;
    z.template head<3>() = v + skew<S>(lever) * w;
    z[3] = w.z();
    return z;
  }

  struct Prediction {
    Measured<double> z;                                           ///< predicted from the camera state
    Eigen::Matrix<double, size, FreeCameraMotion::error_size> H;  ///< d(z) / d(camera error)
    Eigen::Matrix<double, size, size> R;
  };

  Prediction predict_measurement(const FreeCameraMotion::State<double>& camera) const;

  static Measured<double> measured(const Eigen::Vector2d& wheels) { return {wheels[0], 0, 0, wheels[1]}; }
};

}  // namespace incognita
