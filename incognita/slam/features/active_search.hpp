// Active search for the predicted features: thesis C.2.
#pragma once

#include "incognita/slam/features/feature.hpp"
#include "incognita/vision/pyramid.hpp"

namespace incognita {

/// Searches for the predicted features in the order of decreasing expected information gain (the most uncertain first,
/// unless they hardly matched of late; with SearchSettings::anchors_first, anchors that match more often than not before all
/// others), at most `max_measurements` of them, each inside its own ellipse. Fills measured, correlation and outcome (not_found
/// or matched, before outlier rejection) of the camera's matches, and counts the features that were searched for.
void active_search(const ImagePyramid& image, TrackedCamera& camera);

/// Sets the outcome of matches that are inconsistent with the others to `outlier`, or to `unconfirmed`, and counts the
/// remaining ones.
void reject_outliers(const Estimate& estimate, TrackedCamera& camera);

}  // namespace incognita
