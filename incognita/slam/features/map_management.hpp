// Keeping the map small and good: thesis C.4.
#pragma once

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// Counts for how many frames each landmark was not matched; of every frame that is tracked.
void count_frames_away(Estimate& estimate);

/// Counts this frame's searches. A frame that matched hardly anything says nothing about single landmarks
/// (the lens may be covered), so the caller leaves it out.
void count_attempts(Estimate& estimate);

/// Deletes landmarks that were matched in less than the wanted share of their attempts, and inverse-depth
/// landmarks whose depth went negative. Anchors stay. The looks of this frame lose their indices: call it
/// last.
void delete_bad_landmarks(Estimate& estimate, const MapSettings& settings);

/// Turns inverse-depth landmarks into points where that changes nothing any more (Civera's index).
void simplify_landmarks(Estimate& estimate, const InitializationSettings& settings);

}  // namespace incognita
