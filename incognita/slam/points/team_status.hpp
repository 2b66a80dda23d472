// The tracking status: whether the estimate can be trusted, and why not.
#pragma once

#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

/// The status after the present tick. Updates the counters that it rests on (ticks in a row without a match, or with
/// large innovations).
///
/// `lost`: a pose or a covariance is not finite; a position sigma is above its limit; or, for `max_ticks` in a row,
/// there were detections and none was matched while `min_expected` landmarks were predicted in view, or the normalized
/// innovations were above `max_innovation_sigmas` rms. `degraded`: an update was refused, a joint association was
/// incomplete, or the innovations are improbably large.
TrackingStatus assess(TeamEstimate& estimate, const TeamSettings& settings);

}  // namespace incognita
