// Active search for the predicted features: thesis C.2.
#pragma once

#include <vector>

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

/// Searches for the features in the order of decreasing innovation covariance (the most uncertain have the
/// largest expected information gain), at most `max_measurements` of them, each inside its own ellipse. Fills
/// measured, correlation and outcome (not_found or matched, before outlier rejection). Returns the number of
/// features searched for.
int active_search(const SummedImage& image, const std::vector<Landmark>& catalog,
                  const SearchSettings& settings, std::vector<FeatureMatch>& matches);

/// Sets the outcome of matches that are inconsistent with the others to `outlier`, or to `unconfirmed`.
/// Returns the number of remaining matches.
int reject_outliers(const Estimate& estimate, const CameraSlamSettings& settings,
                    std::vector<FeatureMatch>& matches);

}  // namespace incognita
