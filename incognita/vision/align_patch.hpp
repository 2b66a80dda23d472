// Alignment of a patch with the image at a fraction of a pixel, by Gauss-Newton (Lucas and Kanade 1981; Baker and
// Matthews 2004).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "incognita/vision/image.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

/// Where the landmark is in the image, px: the squared difference between image and warped texture, over a patch of side `size`
/// px, is least there. The texture is sampled where the pixels are, its brightness scaled and shifted to that of the image.
/// At most three steps from `start`, px, which must be nearer than about a pixel; the last one counts even if the next would
/// be longer than a hundredth of a pixel: where part of the patch is hidden it is still better than the peak of the correlation.
///
/// `texture_from_view`: texture pixels per view pixel, 2x2, as for warp(). Nothing when the patch and one pixel around it are not
/// in the image, or two pixels around it not in the texture, when the patch has no gradient along some direction, or when a
/// step leads more than a pixel away from `start`.
std::optional<Eigen::Vector2d> align_patch(const Image& image, const PatchTexture& texture,
                                           const Eigen::Matrix2d& texture_from_view, int size,
                                           const Eigen::Vector2d& start);

}  // namespace incognita
