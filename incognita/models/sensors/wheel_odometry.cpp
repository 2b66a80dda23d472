#include "incognita/models/sensors/wheel_odometry.hpp"

namespace incognita {

WheelOdometry::Prediction WheelOdometry::predict_measurement(
    const FreeCameraMotion::State<double>& camera) const {
  const Eigen::Matrix3d C = mount.body_from_camera();
  const Eigen::Matrix3d camera_from_world =
      rotation_matrix<double>(free_camera::orientation(camera)).transpose();
  const Eigen::Vector3d v = camera_from_world * free_camera::velocity(camera);
  Prediction out{h<double>(camera), {}, {}};
  out.H.setZero();
  out.H.block<3, 3>(0, 3) = C * skew<double>(v);  // error e rotates R' v by v x e
  out.H.block<3, 3>(0, 6) = C * camera_from_world;
  out.H.block<3, 3>(0, 9) = skew<double>(mount.lever()) * C;
  out.H.block<1, 3>(3, 9) = C.row(2);
  const double slip = sigma_slip_m_s * sigma_slip_m_s;
  out.R = Measured<double>(sigma_speed_m_s * sigma_speed_m_s + slip, slip, slip,
                           sigma_turn_rate_rad_s * sigma_turn_rate_rad_s)
              .asDiagonal();
  return out;
}

}  // namespace incognita
