// The tracking status of the estimate, with its reason: one definition for all bodies and sensors.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// Largest standard deviation of a body's position along any direction, m.
double sigma_position(const Body& body);

/// Status after the current tick, which `estimate.last` reports; updates `estimate.health`.
///
/// `lost`: a pose or covariance is not finite; a position sigma exceeds its limit; for `max_ticks` consecutive
/// frames fewer than `min_matches` measurements corrected the filter, those of other sensors included; for as many
/// ticks there were detections but no match with `min_expected` landmarks predicted in view; or the rms normalized
/// innovation exceeded `max_innovation_sigmas` for as many updates. `degraded`: the last frame had too few matches, an
/// update was rejected, a joint association was incomplete, or the innovations are improbably large.
///
/// `frames`: of the cameras at this tick: 0 between images and without cameras, more than 1 if images are overdue.
TrackingStatus assess(Estimate& estimate, int frames, const EstimatorSettings& settings);

}  // namespace incognita
