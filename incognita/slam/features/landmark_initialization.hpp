// Where new landmarks come from: thesis C.2, C.3, C.4.
#pragma once

#include <string>

#include "incognita/math/random.hpp"
#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {

/// A corner worth a landmark: the best in a box placed at random where no landmark is expected, and not about
/// to leave the view at the present velocity. Nothing when a few boxes held none.
std::optional<Eigen::Vector2d> find_new_corner(const Image& image, const Estimate& estimate,
                                               const Camera& camera, const CameraSlamSettings& settings,
                                               RandomStream& random);

/// Adds a landmark seen at a pixel of this image, as an inverse-depth landmark or as a line with depth
/// hypotheses, as the settings say. False when no patch can be cut or no ray reaches the pixel.
bool initialize_landmark(const Image& image, const Eigen::Vector2d& pixel, Estimate& estimate,
                         const Camera& camera, const CameraSlamSettings& settings);

/// The patch around a pixel with the view it is seen from; the normal faces the camera.
std::optional<PatchView> cut_view(const Image& image, const Eigen::Vector2d& pixel, const CameraState& from,
                                  const Camera& camera, const CameraSlamSettings& settings);

}  // namespace incognita
