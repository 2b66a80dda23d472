// The tree of settings: which settings a scenario has follows from its choices.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "incognita/io/scenario/setting_reader.hpp"

namespace incognita {

/// A camera from a calibration, with its source.
struct FoundCamera {
  CameraSettings camera;
  std::string source;
};

/// Reads the calibration `camera.file`, or without one searches for that of the recording. Throws InputError.
using CameraFinder = std::function<std::optional<FoundCamera>(const Scenario&)>;

/// Visits every setting of the scenario from the top of the tree: world, sensor, vehicle, and what they need.
void read_settings(SettingReader& reader, Scenario& scenario, const CameraFinder& find_camera = {});

/// Visits the settings of a camera.
void read_camera(SettingReader& reader, CameraSettings& camera);

}  // namespace incognita
