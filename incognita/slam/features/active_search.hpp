// Looking for what is expected: the active search of thesis C.2.
#pragma once

#include <vector>

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

/// Searches for the most uncertain looks first (largest innovation covariance: what is hardest to predict
/// teaches most), at most `max_measurements` of them, each inside its own ellipse. Fills measured,
/// correlation and outcome (not_found, or matched until the consensus says otherwise). Returns how many were
/// searched for.
int active_search(const SummedImage& image, const std::vector<Landmark>& catalog,
                  const SearchSettings& settings, std::vector<FeatureMatch>& matches);

/// Takes back the matches that do not agree with the others (outcome `inconsistent`). Returns how many
/// remain.
int reject_outliers(const Estimate& estimate, const CameraSlamSettings& settings,
                    std::vector<FeatureMatch>& matches);

}  // namespace incognita
