// One vehicle on a plane that measures ranges and bearings: its settings as those of an estimator.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// `anchor_identities`: the identities that the sensor gives the anchors of the settings, in their order; needed for
/// association by identity, else empty. Throws std::invalid_argument for a vehicle model that is not on a plane, and
/// where identities are needed and missing.
TeamSettings single_vehicle(const PlanarSlamSettings& settings,
                            const std::vector<std::int64_t>& anchor_identities = {});

}  // namespace incognita
