// Builds the camera of a scenario.
#pragma once

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/models/camera.hpp"

namespace incognita {

/// Throws std::invalid_argument, "camera fu_px must be ...", for invalid parameters, or if the distortion
/// leaves most of the image without rays, e.g. because its unit is wrong.
Camera make_camera(const CameraSettings& settings);

}  // namespace incognita
