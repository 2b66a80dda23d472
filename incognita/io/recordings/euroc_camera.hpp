// The camera of a EuRoC recording, as its cam0/sensor.yaml calibrates it.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct CalibratedCamera {
  std::filesystem::path file;
  CameraSettings camera;  ///< meaningful where `unfit` is empty
  std::string unfit;      ///< why no camera model of this program is this camera
};

struct EurocSensor {
  std::optional<CalibratedCamera> camera;           ///< nothing where the file has no intrinsics
  std::optional<Eigen::Matrix4d> body_from_camera;  ///< T_BS
};

/// Throws InputError naming file, line and remedy where the file is no YAML or what it says makes no sense.
EurocSensor read_euroc_sensor(const std::filesystem::path& file);

}  // namespace incognita
