// The camera in EuRoC's sensor.yaml.
#pragma once

#include <filesystem>

#include "incognita/io/calibrations/calibrated_camera.hpp"
#include "incognita/io/calibrations/yaml_map.hpp"

namespace incognita {

/// Throws InputError naming file, line and remedy for invalid values.
CalibratedCamera camera_in_euroc_sensor(const YamlMap& map, const std::filesystem::path& file);

}  // namespace incognita
