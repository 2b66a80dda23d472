// Settings of a range-bearing vehicle on a plane, converted to those of a team of one.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/slam/mapper/settings.hpp"
#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

/// `anchor_identities`: the identities of the anchors in sensor data, in the order of the settings; required
/// for association by identity, else empty. Throws std::invalid_argument for a vehicle model that is not
/// planar, and for missing identities.
EstimatorSettings single_vehicle(const PlanarSlamSettings& settings,
                                 const std::vector<std::int64_t>& anchor_identities = {});

}  // namespace incognita
