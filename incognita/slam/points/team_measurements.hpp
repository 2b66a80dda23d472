// Linearized measurements of landmarks, anchors and other vehicles, and landmark initialization.
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

/// Covariance R of a measurement.
SmallMatrix detection_noise(const TeamMember& member, const SmallVector& z);

/// Linearizes a detection by `vehicle` of an anchor, a mapped landmark or (`of_vehicle`) another team member.
/// The Jacobians are taken at the belief's means or, for first-estimate Jacobians, at the first estimates.
/// Nothing when the sensor cannot measure the predicted point, when the landmark is not mapped, or when the
/// other vehicle is too close for a first-order model.
std::optional<LinearizedDetection> linearize_detection(const TeamEstimate& estimate, int vehicle,
                                                       bool of_vehicle, const PointDetection& detection,
                                                       const TeamSettings& settings);

/// A position fix of a vehicle (world, m), linearized at the belief's means.
LinearizedMeasurement linearized_fix(const TeamEstimate& estimate, std::size_t vehicle,
                                     const Eigen::Vector2d& fix, const TeamSettings& settings);

/// The measured point in the map frame, from the current mean of the vehicle; nothing when the measurement is
/// not usable (not finite, or no positive range) or the sensor measures no distance.
std::optional<SmallVector> point_of(const TeamEstimate& estimate, int vehicle, const SmallVector& z,
                                    const TeamSettings& settings);

/// Position of an anchor (world, m) in the map frame.
SmallVector anchor_position(const TeamEstimate& estimate, const SmallVector& anchor);

/// Whether a measurement is finite, of the right size, and its range, if the sensor has one, positive.
bool is_usable(const AnySensor& sensor, const SmallVector& z);

/// Sets residual and noise for another measurement of the same point; prediction and Jacobians are kept.
void set_residual(LinearizedDetection& measurement, const TeamMember& member, const SmallVector& z);

/// Adds a landmark to the map, (2.20)-(2.26). False when the detection does not define one.
bool initialize_landmark(TeamEstimate& estimate, int vehicle, const PointDetection& detection,
                         const TeamSettings& settings);

/// Converts converged inverse depths to points, and removes landmarks whose inverse depth became negative.
void convert_converged_inverse_depths(TeamEstimate& estimate, const TeamSettings& settings);

}  // namespace incognita
