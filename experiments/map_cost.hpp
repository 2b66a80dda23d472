// What a step of range-bearing SLAM costs as the map grows, with a full or a block-diagonal map covariance.
#pragma once

#include "incognita/belief/belief.hpp"

namespace incognita {

/// A vehicle at the origin, the belief's block 0, with landmarks in a ring about it.
Belief belief_with_landmarks(int landmarks, MapCorrelations correlations);

/// Seconds of the fastest of 60 steps, each a prediction and an update with ten measurements of ten
/// landmarks, on a map of a given number of them. Times depend on the machine; only their growth is meaningful.
double step_seconds(int landmarks, MapCorrelations correlations);

}  // namespace incognita
