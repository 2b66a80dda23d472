// Converts a picture of a target to the target's coordinates.
#pragma once

#include "incognita/slam/features/target.hpp"

namespace incognita {

/// The target's picture from an image of the whole target. `corner_px` has a row (u, v) per corner, px, (0,
/// 0) is the center of the first pixel. Images of more than 100 px per side are reduced by averaging, as a
/// camera sees no finer detail. Throws std::invalid_argument with the requirement that is violated: taken
/// straight on, not mirrored, square pixels, corners inside the image, distinct, and at their positions to a
/// quarter of a pixel.
Target::Picture target_picture_from(const Target& target, const Image& whole,
                                    const Eigen::MatrixX2d& corner_px);

}  // namespace incognita
