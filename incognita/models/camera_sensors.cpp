#include "incognita/models/camera_sensors.hpp"

namespace incognita {
namespace {

/// A Jacobian by the camera's error as one by the vehicle's.
template <int rows>
SmallMatrix through(const Eigen::Matrix<double, rows, FreeCameraMotion::error_size>& by_camera,
                    const MountedPose& pose) {
  return by_camera.template leftCols<6>() * pose.J;
}

}  // namespace

std::string incompatibility_of_camera(const MotionTraits& motion) {
  return motion.on_line() ? std::string(line_needs_relative_position) : "";
}

std::optional<AnyLook> CarriedCamera::predict_measurement(const MountedPose& pose, const LandmarkForm& form,
                                                          const SmallVector& landmark) const {
  const auto as_any = [&](const auto& prediction) -> std::optional<AnyLook> {
    if (!prediction) return std::nullopt;
    return AnyLook{prediction->pixel, through(prediction->Hv, pose), prediction->Hl,
                   camera.contains(prediction->pixel)};
  };
  if (form.kind == LandmarkForm::Kind::point)
    return as_any(PointLandmark::look(camera, pose.camera, Eigen::Vector3d(landmark)));
  return as_any(
      InverseDepthLandmark{form.birth_axes}.look(camera, pose.camera, InverseDepthLandmark::State(landmark)));
}

std::optional<AnyBirth> CarriedCamera::initialize(const MountedPose& pose, const SmallVector& z,
                                                  double inverse_depth) const {
  const auto born = InverseDepthLandmark::birth(camera, pose.camera, Eigen::Vector2d(z), inverse_depth);
  if (!born) return std::nullopt;
  return AnyBirth{{LandmarkForm::Kind::inverse_depth, born->world_from_birth},
                  InverseDepthLandmark::chart,
                  born->landmark,
                  through(born->Jv, pose),
                  born->Jz,
                  SmallVector::Unit(6, 5)};
}

std::optional<AnyLook> CarriedStereo::predict_measurement(const MountedPose& pose, const LandmarkForm& form,
                                                          const SmallVector& landmark) const {
  const auto as_any = [&](const auto& prediction) -> std::optional<AnyLook> {
    if (!prediction) return std::nullopt;
    return AnyLook{prediction->z, through(prediction->Hv, pose), prediction->Hl,
                   stereo.contains(*prediction)};
  };
  if (form.kind == LandmarkForm::Kind::point)
    return as_any(stereo.look(pose.camera, Eigen::Vector3d(landmark)));
  return as_any(
      stereo.look(pose.camera, InverseDepthLandmark{form.birth_axes}, InverseDepthLandmark::State(landmark)));
}

std::optional<AnyBirth> CarriedStereo::initialize(const MountedPose& pose, const SmallVector& z,
                                                  double) const {
  const auto born = stereo.distant_birth(pose.camera, Eigen::Vector3d(z));
  if (!born) return std::nullopt;
  return AnyBirth{{LandmarkForm::Kind::inverse_depth, born->form.world_from_birth},
                  InverseDepthLandmark::chart,
                  born->landmark,
                  through(born->Jv, pose),
                  born->Jz,
                  {}};
}

}  // namespace incognita
