// Whether what was taken for the target looks like it all over, and not only at its corners.
#pragma once

#include "incognita/slam/features/target.hpp"
#include "incognita/slam/features/target_pose.hpp"

namespace incognita {

/// Normalised cross-correlation, in [-1, 1], of the target's picture with what is seen where `pose` puts it;
/// -1 where less than half of it is in the image, or either is of one grey.
/// Throws std::invalid_argument where the target has no picture.
double correlation_with_picture(const Target& target, const Camera& camera, const Image& image,
                                const TargetPose& pose);

}  // namespace incognita
