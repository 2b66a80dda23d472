// Map management: thesis C.4.
#pragma once

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// Counts the frames since the last match of each landmark; for every tracked frame.
void count_frames_away(Estimate& estimate);

/// Counts this frame's searches. The caller skips frames with hardly any match, which carry no information
/// about single landmarks (e.g. a covered lens).
void count_attempts(Estimate& estimate);

/// Deletes points and inverse-depth landmarks that were matched in too small a share of their attempts, and
/// inverse-depth landmarks of negative depth. Invalidates the landmark indices of this frame's matches: call it last.
void delete_bad_landmarks(Estimate& estimate, const MapSettings& settings);

/// Converts inverse-depth landmarks of small linearity index (Civera) to points.
void simplify_landmarks(Estimate& estimate, const InitializationSettings& settings);

}  // namespace incognita
