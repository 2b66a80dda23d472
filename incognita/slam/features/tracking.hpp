// The tracking status of the camera estimator.
#pragma once

#include "incognita/slam/features/estimate.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// The status after a frame in which `matched` of `searched` features updated the filter.
TrackingStatus assess(const TrackingStatus& before, int matched, int searched, double sigma_position_m,
                      const CameraSlamSettings& settings);

/// Largest standard deviation of the camera's position along any direction, m.
double sigma_position(const Estimate& estimate);

}  // namespace incognita
