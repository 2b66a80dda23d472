// The camera that a scenario describes.
#pragma once

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/models/camera.hpp"

namespace incognita {

/// Throws std::invalid_argument, "camera fu_px must be ...", when there can be no such camera, or when its
/// distortion hides most of the image, as it does when it is given in the wrong unit.
Camera make_camera(const CameraSettings& settings);

}  // namespace incognita
