// What a sighting says of a landmark or of another vehicle, to the engine; and a landmark's birth from one.
#pragma once

#include <optional>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/points/team_estimate.hpp"
#include "incognita/slam/points/team_settings.hpp"

namespace incognita {

struct LinearizedDetection {
  LinearizedMeasurement linearized;
  SmallVector predicted;
};

/// Covariance of a measurement.
SmallMatrix detection_noise(const TeamMember& member, const SmallVector& z);

/// A sighting that `vehicle` has of an anchor, a mapped landmark, or (`of_vehicle`) another one of the team,
/// linearised about the belief's means or, for first-estimate Jacobians, about what was known first. Nothing
/// where the sensor could not have it, for a landmark that is not mapped yet, or for another vehicle that
/// is nearer than first order reaches.
std::optional<LinearizedDetection> linearize_detection(const TeamEstimate& estimate, int vehicle,
                                                       bool of_vehicle, const PointDetection& detection,
                                                       const TeamSettings& settings);

/// A position fix of a vehicle (world, m), linearized about the belief's means.
LinearizedMeasurement linearized_fix(const TeamEstimate& estimate, std::size_t vehicle,
                                     const Eigen::Vector2d& fix, const TeamSettings& settings);

/// The point that a detection places in the frame of the map, from the vehicle's present mean; nothing where it is not
/// usable (not finite, or no positive range) or the sensor measures no distance.
std::optional<SmallVector> point_of(const TeamEstimate& estimate, int vehicle, const SmallVector& z,
                                    const TeamSettings& settings);

/// Where an anchor (world, m) is in the frame of the map.
SmallVector anchor_position(const TeamEstimate& estimate, const SmallVector& anchor);

/// Whether the numbers of a detection are finite, and its range, where the sensor measures one, is positive.
bool is_usable(const AnySensor& sensor, const SmallVector& z);

/// Makes it the same look with another measurement: residual and noise are that one's.
void set_residual(LinearizedDetection& measurement, const TeamMember& member, const SmallVector& z);

/// A new landmark, (2.20)-(2.26). False when none can be made of it.
bool initialize_landmark(TeamEstimate& estimate, int vehicle, const PointDetection& detection,
                         const TeamSettings& settings);

/// Turns inverse depths into points where that changes nothing any more, and forgets those whose depth became
/// negative.
void convert_converged_inverse_depths(TeamEstimate& estimate, const TeamSettings& settings);

}  // namespace incognita
