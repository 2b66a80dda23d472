// The belief of a map whose first estimate was wrong, once bundle adjustment found another: covariances that were linearized at
// wrong depths and poses are worth nothing.
#pragma once

#include "incognita/slam/bundle/keyframes.hpp"
#include "incognita/slam/features/feature.hpp"

namespace incognita {

/// Landmarks that began in the first keyframe start anew, with the inverse depths of the keyframes (1/m) as means and the
/// uncertainty of new landmarks; others are removed. The camera, which must be the body itself, is set to the pose of the last
/// keyframe, with velocity and rate from the one before. The matches of the frame, the last keyframe, then correct the belief, after
/// outliers were rejected anew.
void renew_map(const Keyframes& keyframes, Estimate& estimate, TrackedCamera& camera);

}  // namespace incognita
