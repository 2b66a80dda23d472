#include "incognita/models/sensors/camera_sensors.hpp"

namespace incognita {
namespace {

/// Jacobian with respect to the vehicle error, from that with respect to the camera error.
template <int rows>
SmallMatrix through(const Eigen::Matrix<double, rows, FreeCameraMotion::error_size>& by_camera,
                    const MountedPose& pose) {
  return by_camera.template leftCols<6>() * pose.J;
}

}  // namespace

std::string incompatibility_of_camera(const MotionTraits& motion) {
  return motion.on_line() ? std::string(line_needs_relative_position) : "";
}

std::optional<AnyPrediction> CameraSensor::predict_measurement(const MountedPose& pose,
                                                               const LandmarkParametrization& form,
                                                               const SmallVector& landmark) const {
  const auto as_any = [&](const auto& prediction) -> std::optional<AnyPrediction> {
    if (!prediction) return std::nullopt;
    return AnyPrediction{prediction->pixel, through(prediction->Hv, pose), prediction->Hl,
                         camera.contains(prediction->pixel)};
  };
  if (form.kind == LandmarkParametrization::Kind::point)
    return as_any(PointLandmark::predict_measurement(camera, pose.camera, Eigen::Vector3d(landmark)));
  return as_any(InverseDepthLandmark{form.initial_axes}.predict_measurement(
      camera, pose.camera, InverseDepthLandmark::State(landmark)));
}

std::optional<AnyInitialization> CameraSensor::initialize(const MountedPose& pose, const SmallVector& z,
                                                          double inverse_depth) const {
  const auto initialized =
      InverseDepthLandmark::initialize(camera, pose.camera, Eigen::Vector2d(z), inverse_depth);
  if (!initialized) return std::nullopt;
  return AnyInitialization{
      {LandmarkParametrization::Kind::inverse_depth, initialized->world_from_initial_camera},
      InverseDepthLandmark::chart,
      initialized->landmark,
      through(initialized->Jv, pose),
      initialized->Jz,
      SmallVector::Unit(6, 5)};
}

std::optional<AnyPrediction> StereoSensor::predict_measurement(const MountedPose& pose,
                                                               const LandmarkParametrization& form,
                                                               const SmallVector& landmark) const {
  const auto as_any = [&](const auto& prediction) -> std::optional<AnyPrediction> {
    if (!prediction) return std::nullopt;
    return AnyPrediction{prediction->z, through(prediction->Hv, pose), prediction->Hl,
                         stereo.contains(*prediction)};
  };
  if (form.kind == LandmarkParametrization::Kind::point)
    return as_any(stereo.predict_measurement(pose.camera, Eigen::Vector3d(landmark)));
  return as_any(stereo.predict_measurement(pose.camera, InverseDepthLandmark{form.initial_axes},
                                           InverseDepthLandmark::State(landmark)));
}

std::optional<AnyInitialization> StereoSensor::initialize(const MountedPose& pose, const SmallVector& z,
                                                          double) const {
  const auto initialized = stereo.initialize_inverse_depth(pose.camera, Eigen::Vector3d(z));
  if (!initialized) return std::nullopt;
  return AnyInitialization{
      {LandmarkParametrization::Kind::inverse_depth, initialized->form.world_from_initial_camera},
      InverseDepthLandmark::chart,
      initialized->landmark,
      through(initialized->Jv, pose),
      initialized->Jz,
      {}};
}

}  // namespace incognita
