// Prediction of the vehicles through their time-stamped inputs and position fixes.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// Predicts one vehicle to the time of the tick: through its odometry readings, each held until the next, or through
/// the one input that it carried out since the last tick. Position fixes correct it at their own times, where the
/// vehicle uses them. Nothing moves before the first input. Sets `estimate.refused` when a fix was refused.
void predict_vehicle(TeamEstimate& estimate, std::size_t which, const BodyObservation& view, double t,
                     const TeamSettings& settings);

/// Re-expresses a map in the vehicle's frame in the present frame of the vehicle. No-op for a map in the world.
void recenter_map(TeamEstimate& estimate);

}  // namespace incognita
