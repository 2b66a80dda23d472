// What a sighting says of a landmark or of another vehicle, to the engine; and a landmark's birth from one.
#pragma once

#include <optional>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

struct LinearisedSighting {
  AffineLook look;
  SmallVector predicted;
};

/// Covariance of a measurement.
SmallMatrix sighting_noise(const TeamMember& member, const SmallVector& z);

/// A sighting that `vehicle` has of an anchor, a mapped landmark, or (`of_vehicle`) another one of the team,
/// linearised about the belief's means or, for first-estimate Jacobians, about what was known first. Nothing
/// where the sensor could not have it, for a landmark that is not mapped yet, or for another vehicle that
/// is nearer than first order reaches.
std::optional<LinearisedSighting> linearised_sighting(const TeamEstimate& estimate, int vehicle,
                                                      bool of_vehicle, const Sighting& sighting,
                                                      const TeamSettings& settings);

/// Makes it the same look with another measurement: residual and noise are that one's.
void measure(LinearisedSighting& look, const TeamMember& member, const SmallVector& z);

/// A new landmark, (2.20)-(2.26). False when none can be made of it.
bool give_birth(TeamEstimate& estimate, int vehicle, const Sighting& sighting, const TeamSettings& settings);

/// Turns inverse depths into points where that changes nothing any more, and forgets those whose depth became
/// negative.
void settle_depths(TeamEstimate& estimate, const TeamSettings& settings);

}  // namespace incognita
