// Initialization of new landmarks: thesis C.2, C.3, C.4.
#pragma once

#include <span>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/slam/features/feature.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {

/// The best corner in a box placed at random where no landmark is predicted, if it stays in view at the
/// current velocity. Nothing when a few boxes contain none.
std::optional<Eigen::Vector2d> find_new_corner(const Image& image, const Estimate& estimate,
                                               const TrackedCamera& camera, RandomStream& random);

/// The strongest corners of the cells of a grid over the image that contain no predicted landmark, at most `count`, strongest
/// first; each as find_new_corner() would accept it, and none that is covered, with `gap_m` of is_covered(); 0: none is.
std::vector<Eigen::Vector2d> find_new_corners(const Image& image, const Estimate& estimate,
                                              const TrackedCamera& camera, int count, int cell_px,
                                              double gap_m);
/// Whether a ray passes a landmark within half of `gap_m`, at the distance of the landmark. `ray` and `landmarks` in the frame of
/// the camera, m.
bool is_covered(const Eigen::Vector3d& ray, std::span<const Eigen::Vector3d> landmarks, double gap_m);
/// Side of the cells, px, of which half hold a landmark if as many as wanted are in view.
int cell_of_wanted_px(const TrackedCamera& camera);

/// Adds a landmark at a pixel of this image, as an inverse-depth landmark or as a ray with depth hypotheses,
/// according to the settings. False when no patch can be cut or no ray maps to the pixel.
bool initialize_from_image(const ImagePyramid& image, const Eigen::Vector2d& pixel, Estimate& estimate,
                           TrackedCamera& camera);

/// Adds a landmark at a known position (world, m), with its appearance.
void add_anchor(const Eigen::Vector3d& position, PatchView view, Estimate& estimate, TrackedCamera& camera);

/// The patch around a pixel with the view it is seen from; its assumed normal faces the camera.
std::optional<PatchView> cut_view(const ImagePyramid& image, const Eigen::Vector2d& pixel,
                                  const CameraState& from, const Camera& camera,
                                  const CameraSlamSettings& settings);

}  // namespace incognita
