// Builds the camera of a scenario.
#pragma once

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/models/sensors/camera.hpp"

namespace incognita {

/// Throws UnfitSetting for a principal point outside of the image, and if the distortion leaves most of the image
/// without rays, e.g. because its unit is wrong.
Camera make_camera(const CameraSettings& settings);

}  // namespace incognita
