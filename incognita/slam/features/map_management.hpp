// Map management: thesis C.4.
#pragma once

#include "incognita/slam/features/feature.hpp"

namespace incognita {

/// Counts the frames for which each feature is known, in or out of view, and without a match; for every tracked frame.
void count_frames(TrackedCamera& camera);

/// Counts this frame's searches. The caller skips frames with hardly any match, which carry no information
/// about single landmarks (e.g. a covered lens).
void count_attempts(Estimate& estimate, TrackedCamera& camera);

/// Probability that a search for a landmark in view succeeds: the share of its recent searches that did, with one more
/// success, so that a new landmark is expected to match. 1 without MapSettings::memory_attempts.
double match_probability(const Feature& feature);

/// Expected number of matches in this frame if all landmarks in view are searched for. Landmarks that stopped matching do
/// not count, so that new ones take their place.
double expected_matches(const TrackedCamera& camera);

/// Deletes points and inverse-depth landmarks that were matched in too small a share of their attempts (with
/// MapSettings::memory_attempts, of the recent ones), and inverse-depth landmarks of negative depth.
void delete_bad_landmarks(Estimate& estimate, TrackedCamera& camera);

/// Deletes up to `count` landmarks that are out of view, those with the fewest matches first: they are the least likely to be
/// recognized. Returns their number.
int delete_least_matched(Estimate& estimate, TrackedCamera& camera, int count);

/// Converts inverse-depth landmarks of small linearity index (Civera) to points.
void simplify_landmarks(Estimate& estimate, const TrackedCamera& camera);

/// Removes a landmark from the map, the belief and the camera.
void remove_landmark(Estimate& estimate, TrackedCamera& camera, std::int64_t id);

}  // namespace incognita
