// The tracking status of the estimate, with its reason.
#pragma once

#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// Status after the current tick; updates its counters (consecutive ticks without a match, or with large
/// innovations).
///
/// `lost`: a pose or covariance is not finite; a position sigma exceeds its limit; or for `max_ticks`
/// consecutive ticks there were detections but no match with `min_expected` landmarks predicted in view, or
/// the rms normalized innovation exceeded `max_innovation_sigmas`. `degraded`: an update was rejected, a
/// joint association was incomplete, or the innovations are improbably large.
TrackingStatus assess(TeamEstimate& estimate, const TeamSettings& settings);

}  // namespace incognita
