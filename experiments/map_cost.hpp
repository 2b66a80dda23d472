// What a step of range-bearing SLAM costs as the map grows, with the map's correlations kept or dropped.
#pragma once

#include "incognita/belief/belief.hpp"

namespace incognita {

/// Seconds of the fastest of 60 steps, each a prediction and an update with ten looks at ten landmarks, on a
/// map of so many. Times are of this machine and this moment; how they grow is what is asked.
double step_seconds(int landmarks, MapCorrelations correlations);

}  // namespace incognita
