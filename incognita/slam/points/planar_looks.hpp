// What a detection says of a landmark, to the engine; and a landmark's birth from one.
#pragma once

#include <optional>

#include "incognita/slam/points/planar_estimate.hpp"
#include "incognita/slam/points/planar_settings.hpp"

namespace incognita {

/// Covariance of range and bearing.
Eigen::Matrix2d detection_noise(const Detection& detection, const RangeBearingSettings& sensor);

/// A detection as one of a landmark, linearised about the belief's means or, for first-estimate Jacobians,
/// about what was known of vehicle and landmark first. Nothing for a landmark where the sensor is.
struct LandmarkLook {
  AffineLook look;
  Eigen::Vector2d predicted;  ///< range (m), bearing (rad)
};
std::optional<LandmarkLook> look_at(const PlanarEstimate& estimate, const PlanarLandmark& landmark,
                                    const Detection& detection, const PlanarSlamSettings& settings);

/// Where an external sensor sees the vehicle.
AffineLook look_of_fix(const PlanarEstimate& estimate, const Eigen::Vector2d& fix, double sigma_m);

/// A new landmark, (2.20)-(2.26): index in the catalogue.
std::size_t give_birth(PlanarEstimate& estimate, const Detection& detection,
                       const PlanarSlamSettings& settings);

}  // namespace incognita
