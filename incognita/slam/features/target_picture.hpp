// Verification of a detected target by its whole picture instead of its corners only.
#pragma once

#include "incognita/slam/features/target.hpp"
#include "incognita/slam/features/target_pose.hpp"

namespace incognita {

/// Normalized cross-correlation, in [-1, 1], of the target's picture with the image at `pose`; -1 when less
/// than half of it is in the image, or either is uniform.
/// Throws std::invalid_argument when the target has no picture.
double correlation_with_picture(const Target& target, const Camera& camera, const Image& image,
                                const TargetPose& pose);

}  // namespace incognita
