// Reads the camera of a EuRoC recording from its cam0/sensor.yaml.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct CalibratedCamera {
  std::filesystem::path file;
  CameraSettings camera;  ///< valid if `unfit` is empty
  std::string unfit;      ///< why no camera model of this program fits
};

struct EurocSensor {
  std::optional<CalibratedCamera> camera;           ///< nullopt if the file has no intrinsics
  std::optional<Eigen::Matrix4d> body_from_camera;  ///< T_BS
};

/// Throws InputError naming file, line and remedy for invalid YAML or invalid values.
EurocSensor read_euroc_sensor(const std::filesystem::path& file);

}  // namespace incognita
