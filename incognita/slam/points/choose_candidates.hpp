// Which candidates become landmarks, thesis C.4: "the number of reliable features visible" is kept "close to a predetermined
// value", and they are "widely distributed across the image".
#pragma once

#include <cstddef>
#include <vector>

#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// All candidates (indices into FrameReport::matches) without EstimatorSettings::wanted_visible. Else, of each sensor, as many
/// as are missing in its view; the next one is always that farthest from all features in the image.
std::vector<std::size_t> chosen_candidates(const Estimate& estimate,
                                           const std::vector<std::size_t>& candidates,
                                           const EstimatorSettings& settings);

}  // namespace incognita
