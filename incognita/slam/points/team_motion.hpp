// Prediction of the vehicles with their time-stamped inputs and position fixes.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// Predicts one vehicle to the time of the tick, by its odometry readings, each held until the next, or by the one
/// input executed since the last tick. Position fixes, if used, correct it at their own times with odometry, else at
/// the tick. The vehicle does not move before its first input. Sets `estimate.refused` when a fix is rejected.
void predict_vehicle(TeamEstimate& estimate, std::size_t which, const BodyObservation& view, double t,
                     const TeamSettings& settings);

/// Re-expresses a vehicle-frame map in the current vehicle frame. No-op for a world-frame map.
void recenter_map(TeamEstimate& estimate);

}  // namespace incognita
