// Whether an observation fits the bodies and sensors of an estimator.
#pragma once

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// To be called before anything changes, so that an observation that is refused leaves the estimate as it was. Throws
/// std::invalid_argument for another number of bodies, and for a detection of a sensor or a body that does not exist or
/// with an identity that is reserved for features of cameras.
void check_observation(const Observation& observation, const EstimatorSettings& settings);

}  // namespace incognita
