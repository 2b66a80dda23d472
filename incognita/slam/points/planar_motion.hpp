// Prediction of a vehicle on a plane through what its wheels told.
#pragma once

#include "incognita/belief/affine.hpp"
#include "incognita/slam/points/planar_estimate.hpp"
#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

/// How the vehicle moves while an input is held for dt seconds, a reading or a piece of one, linearised as
/// the filter is set to.
AffineMotion planar_motion(const PlanarEstimate& estimate, const Eigen::Vector2d& input, double dt,
                           const VehicleSettings& vehicle, const PlanarFilterSettings& filter);

/// Carries the estimate to the tick's time: each input is held until the next reading, and each position fix
/// is used at its own time, if fixes are to be used at all. Nothing moves before the first input. False when
/// a fix was refused.
bool predict_through(PlanarEstimate& estimate, const Observation& seen, double t,
                     const PlanarSlamSettings& settings);

/// Where the map is told in the vehicle's frame: tells all from where the vehicle has come to. Else nothing.
void tell_from_vehicle(PlanarEstimate& estimate);

}  // namespace incognita
