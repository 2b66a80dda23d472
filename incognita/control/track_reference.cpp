#include "incognita/control/track_reference.hpp"

namespace incognita {

FreeCameraMotion::Input<double> track_reference(const CameraState& estimate, const Eigen::Vector3d& position,
                                                const Eigen::Vector3d& velocity,
                                                const Eigen::Vector3d& acceleration,
                                                const Eigen::Vector4d& gaze, const Eigen::Vector3d& gaze_rate,
                                                const ControlSettings& settings,
                                                const Eigen::Vector3d& gaze_acceleration) {
  const Eigen::Vector3d f = acceleration -
                            settings.gain_velocity_per_s * (free_camera::velocity(estimate) - velocity) -
                            settings.gain_position_per_s2 * (free_camera::position(estimate) - position);
  const Eigen::Vector4d q = free_camera::orientation(estimate);
  const Eigen::Vector4d to_gaze = quaternion_product<double>(quaternion_conjugate(q), gaze);
  const Eigen::Vector3d alpha = gaze_acceleration +
                                settings.gain_orientation_per_s2 * quaternion_log(to_gaze) -
                                settings.gain_rate_per_s * (free_camera::angular_rate(estimate) - gaze_rate);
  const double most = settings.max_acceleration_m_s2, most_angular = settings.max_angular_acceleration_rad_s2;
  FreeCameraMotion::Input<double> input;
  input << f.cwiseMax(-most).cwiseMin(most), alpha.cwiseMax(-most_angular).cwiseMin(most_angular);
  return input;
}

}  // namespace incognita
