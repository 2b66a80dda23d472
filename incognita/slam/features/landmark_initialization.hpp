// Initialization of new landmarks: thesis C.2, C.3, C.4.
#pragma once

#include <string>

#include "incognita/math/random.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {

/// The best corner in a box placed at random where no landmark is predicted, if it stays in view at the
/// current velocity. Nothing when a few boxes contain none.
std::optional<Eigen::Vector2d> find_new_corner(const Image& image, const Estimate& estimate,
                                               const Camera& camera, const CameraSlamSettings& settings,
                                               RandomStream& random);

/// Adds a landmark at a pixel of this image, as an inverse-depth landmark or as a line with depth hypotheses,
/// according to the settings. False when no patch can be cut or no ray maps to the pixel.
bool initialize_landmark(const Image& image, const Eigen::Vector2d& pixel, Estimate& estimate,
                         const Camera& camera, const CameraSlamSettings& settings);

/// The patch around a pixel with the view it is seen from; its assumed normal faces the camera.
std::optional<PatchView> cut_view(const Image& image, const Eigen::Vector2d& pixel, const CameraState& from,
                                  const Camera& camera, const CameraSlamSettings& settings);

}  // namespace incognita
