// Builds the camera of a scenario.
#pragma once

#include <stdexcept>
#include <string>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/models/sensors/camera.hpp"

namespace incognita {

/// A setting that does not fit the others.
struct UnfitSetting : std::invalid_argument {
  UnfitSetting(std::string of, const std::string& why) : std::invalid_argument(why), key(std::move(of)) {}
  std::string key;
};

/// Throws UnfitSetting for a principal point outside of the image, and if the distortion leaves most of the image
/// without rays, e.g. because its unit is wrong.
Camera make_camera(const CameraSettings& settings);

}  // namespace incognita
