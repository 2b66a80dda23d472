// What the wheels of a vehicle tell of the camera that it carries.
//
// A vehicle that neither lifts off nor slides moves along its forward axis, and turns about its up axis, as
// its wheels say: with l the lever of the camera and C = body_from_camera, both fixed, the axle moves with
//   C R' v + l x C w = (speed, 0, 0),   and   (C w)_z = turn rate,
// v and R the camera's velocity and orientation in the world, w its rate in its own axes. The zeros are as
// good as the speed: no ground lets the axle leave it. How the ground turns the body about its other axes,
// the wheels do not know.
#pragma once

#include <Eigen/Core>

#include "incognita/models/free_camera.hpp"
#include "incognita/models/mount.hpp"

namespace incognita {

struct WheelOdometry {
  static constexpr int size = 4;

  Mount mount;
  double sigma_speed_m_s = 0.05;        ///< of the wheels' speed, held for one reading
  double sigma_turn_rate_rad_s = 0.02;  ///< of their turn rate
  double sigma_slip_m_s = 0.02;         ///< of the axle's velocity beside what the wheels say, per axis

  template <class S>
  using Measured = Eigen::Matrix<S, size, 1>;

  /// Velocity of the axle, forward, left and up (m/s), and turn rate (rad/s): wheels that tell (speed, turn
  /// rate) measure (speed, 0, 0, turn rate).
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
    Measured<double> z;                                           ///< as the camera's state says
    Eigen::Matrix<double, size, FreeCameraMotion::error_size> H;  ///< d(z) / d(error of the camera)
    Eigen::Matrix<double, size, size> R;
  };

  Prediction predict_measurement(const FreeCameraMotion::State<double>& camera) const {
    const Eigen::Matrix3d C = mount.body_from_camera();
    const Eigen::Matrix3d camera_from_world =
        rotation_matrix<double>(free_camera::orientation(camera)).transpose();
    const Eigen::Vector3d v = camera_from_world * free_camera::velocity(camera);
    Prediction out{h<double>(camera), {}, {}};
    out.H.setZero();
    out.H.block<3, 3>(0, 3) = C * skew<double>(v);  // R' v turns by v x e
    out.H.block<3, 3>(0, 6) = C * camera_from_world;
    out.H.block<3, 3>(0, 9) = skew<double>(mount.lever()) * C;
    out.H.block<1, 3>(3, 9) = C.row(2);
    const double slip = sigma_slip_m_s * sigma_slip_m_s;
    out.R = Measured<double>(sigma_speed_m_s * sigma_speed_m_s + slip, slip, slip,
                             sigma_turn_rate_rad_s * sigma_turn_rate_rad_s)
                .asDiagonal();
    return out;
  }

  static Measured<double> measured(const Eigen::Vector2d& wheels) { return {wheels[0], 0, 0, wheels[1]}; }
};

}  // namespace incognita
