// Which landmark each sighting without a name is of, by nearest neighbours: thesis Section 6.3.1, "nearest
// neighbour chi-squared tests are computed to guarantee correct matching".
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

struct ViewAssociation {
  /// Per sighting the number of its landmark or anchor, Detection::unknown where it is of none.
  std::vector<std::int64_t> landmarks;
  std::vector<std::size_t> newcomers;  ///< sightings outside the wide gate of every landmark
  /// All sightings: anchors by number, then the others by what was measured. So the answer, to the last bit,
  /// does not depend on the order in which a sensor tells them, which might say what they are.
  std::vector<std::size_t> order;
};

/// Of one vehicle's view: an anchor is known by its look, no other name is read. Each landmark has one
/// sighting at most and each sighting one landmark, the nearest pair first by the squared Mahalanobis
/// distance r' S^-1 r, S = H P H' + R over the vehicle's and the landmark's errors and their correlations.
/// What is outside every gate and inside a wide one is left alone.
ViewAssociation associate_view(const TeamEstimate& estimate, int vehicle,
                               const std::vector<Sighting>& landmarks, const TeamSettings& settings);

}  // namespace incognita
