// Monocular and stereo cameras as sensors of points in space, mounted on any vehicle with a pose in space.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "incognita/models/motion/mount.hpp"
#include "incognita/models/sensors/sensor_model.hpp"
#include "incognita/models/sensors/stereo_camera.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"

namespace incognita {

/// The pose of a mounted camera with its Jacobian with respect to the vehicle error.
struct MountedPose {
  CameraState camera;  ///< velocity and rate are zero: no measurement depends on them
  SmallMatrix J;       ///< d(camera position and right rotation error) / d(vehicle error)
};

std::string incompatibility_of_camera(const MotionTraits& motion);

/// A monocular camera. On a free camera the mount is ignored: the body is the camera.
struct CameraSensor {
  static constexpr std::string_view name = "camera", word = name;
  static constexpr std::string_view summary = "pixel of a point in space";
  static constexpr int dimensions = 3;
  static constexpr std::array<Quantity, 2> measurement{{{"u", "px", "pixel"}, {"v", "px", "pixel"}}};
  static constexpr Chart chart = Chart::line(2);
  static constexpr bool measures_distance = false;
  static constexpr auto initial_form = LandmarkParametrization::Kind::inverse_depth;
  using Pose = MountedPose;

  Camera camera = WideAngleCamera{};
  Mount mount = {};
  Camera& lens() { return camera; }

  static std::string incompatibility(const MotionTraits& motion) { return incompatibility_of_camera(motion); }
  std::optional<AnyPrediction> predict_measurement(const MountedPose& pose,
                                                   const LandmarkParametrization& form,
                                                   const SmallVector& landmark) const;
  std::optional<AnyInitialization> initialize(const MountedPose& pose, const SmallVector& z,
                                              double inverse_depth) const;
  bool in_field_of_view(const AnyPrediction& prediction, const SensorLimits&) const {
    return prediction.in_view;
  }
  bool is_possible(const SmallVector&) const { return true; }
};

/// A stereo pair, mounted by its left camera.
struct StereoSensor {
  static constexpr std::string_view name = "stereo", word = name;
  static constexpr std::string_view summary =
      "pixel of a point in a left image and its column in the right one";
  static constexpr int dimensions = 3;
  static constexpr std::array<Quantity, 3> measurement{
      {{"u", "px", "pixel"}, {"v", "px", "pixel"}, {"u_right", "px", "pixel"}}};
  static constexpr Chart chart = Chart::line(3);
  static constexpr bool measures_distance = true;
  static constexpr auto initial_form = LandmarkParametrization::Kind::inverse_depth;
  using Pose = MountedPose;

  StereoCamera stereo = {WideAngleCamera{}};
  Mount mount = {};
  Camera& lens() { return stereo.camera; }

  static constexpr auto parameters() {
    using P = Parameter<StereoSensor>;
    return std::array{P{{"baseline", "m"},
                        [](StereoSensor& s) -> double& { return s.stereo.baseline_m; },
                        {0, 100, true},
                        "from the left camera to the right one"},
                      P{{"least_disparity", "px"},
                        [](StereoSensor& s) -> double& { return s.stereo.least_disparity_px; },
                        {0, 1000, true},
                        "with less no landmark is initialized"}};
  }

  static std::string incompatibility(const MotionTraits& motion) { return incompatibility_of_camera(motion); }
  std::optional<AnyPrediction> predict_measurement(const MountedPose& pose,
                                                   const LandmarkParametrization& form,
                                                   const SmallVector& landmark) const;
  std::optional<AnyInitialization> initialize(const MountedPose& pose, const SmallVector& z,
                                              double inverse_depth) const;
  bool in_field_of_view(const AnyPrediction& prediction, const SensorLimits&) const {
    return prediction.in_view;
  }
  bool is_possible(const SmallVector&) const { return true; }
};

}  // namespace incognita
