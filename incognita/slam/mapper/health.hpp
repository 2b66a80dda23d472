// The tracking status of the estimate, with its reason: one definition for all bodies and sensors.
#pragma once

#include <cstddef>
#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// Largest standard deviation of a body's position along any direction, m.
double sigma_position(const Body& body);

/// Status of a body after the current tick, which `estimate.last` and the counts of the bodies report; updates its health.
///
/// `lost`: its pose or covariance is not finite; its position sigma exceeds `max_sigma_position_m`; it has no match, and the
/// sigma of its position relative to what it matched last exceeds `max_sigma_ratio` times the distance (before the first
/// match: that of its position exceeds the one at the start by 10 m); for `max_ticks` consecutive
/// frames fewer than `min_matches` of its measurements corrected the filter, those of other sensors included; for as many
/// ticks there were detections but no match with `min_expected` landmarks predicted in view; or the rms normalized
/// innovation of all bodies exceeded `max_innovation_sigmas` in as many ticks. `degraded`: the last frame had too few
/// matches, an update was rejected, a joint association was incomplete, or the innovations are improbably large.
///
/// `frames`: of its cameras at this tick: 0 between images and without cameras, more than 1 if images are overdue.
TrackingStatus assess(Estimate& estimate, std::size_t body, int frames, const EstimatorSettings& settings);

/// Whether its covariance lets a body with matches be tracked: the limits of both sigmas in assess().
bool is_certain(const Estimate& estimate, std::size_t body, const EstimatorSettings& settings);

/// Counts the ticks whose innovations are too large; once per tick, before the bodies are assessed.
void count_doubted(Estimate& estimate, const HealthSettings& settings);

/// Status of the estimate: that of the body that is worst, with its number unless all have the same reason.
TrackingStatus worst_of(const std::vector<Body>& bodies);

}  // namespace incognita
