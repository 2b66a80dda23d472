// Reads the camera of a EuRoC recording from its cam0/sensor.yaml.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>

#include "incognita/io/calibrations/calibrated_camera.hpp"

namespace incognita {

struct EurocSensor {
  std::optional<CalibratedCamera> camera;           ///< nullopt if the file has no intrinsics
  std::optional<Eigen::Matrix4d> body_from_camera;  ///< T_BS
};

/// Throws InputError naming file, line and remedy for invalid YAML or invalid values.
EurocSensor read_euroc_sensor(const std::filesystem::path& file);

}  // namespace incognita
