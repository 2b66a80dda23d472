// Prediction of the vehicles of a team, each through what it told.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// Carries one vehicle to the tick's time: through its odometry readings, each held until the next, or
/// through the one input that it says it carried out. Nothing moves before anything was told.
void predict_vehicle(TeamEstimate& estimate, std::size_t which, const VehicleView& view, double t,
                     const TeamSettings& settings);

}  // namespace incognita
