// Sensors that a scenario chooses, on vehicles that it chooses: what they measure of a point, and how a landmark is
// initialized from that.
#pragma once

#include <optional>
#include <string>

#include "incognita/models/any_motion.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {

/// What the sensor states about itself.
const SensorTraits& traits_of(const AnySensor& sensor);

/// Why a sensor can not ride on a vehicle; empty when it can.
std::string incompatibility(const AnyMotion& motion, const AnySensor& sensor);

const Chart& chart_of(const AnySensor& sensor);  ///< of a measurement
int dimensions_of(const AnySensor& sensor);      ///< numbers of a point
bool measures_distance(const AnySensor& sensor);

/// Nothing where the sensor has no measurement, as behind a camera. Of motions and sensors that fit.
std::optional<AnyPrediction> predict_measurement(const AnySensor& sensor, const AnyMotion& motion,
                                                 const SmallVector& vehicle,
                                                 const LandmarkParametrization& form,
                                                 const SmallVector& landmark);

/// Whether a sensor with that reach measures a point `distance_m` away that it predicts as `look`.
bool is_in_view(const AnySensor& sensor, const SensorLimits& sensor_limits, const AnyPrediction& prediction,
                double distance_m);

/// Whether the sensor can give such numbers, noise included.
bool is_possible(const AnySensor& sensor, const SmallVector& z);

/// `inverse_depth` (1/m): the mean before anything is known. Nothing where no point can be made of it.
std::optional<AnyInitialization> initialize_landmark(const AnySensor& sensor, const AnyMotion& motion,
                                                     const SmallVector& vehicle, const SmallVector& z,
                                                     double inverse_depth);

/// Where a landmark is. Nothing for one that is at infinity or behind where it was first seen.
std::optional<AnyPoint> position_of(const LandmarkParametrization& form, const SmallVector& landmark);
/// Civera's: below about 0.1 a point does as well. 0 for a point. `vehicle_position`: in the dimensions of
/// the landmark's place.
double linearity_index(const LandmarkParametrization& form, const SmallVector& landmark,
                       double inverse_depth_var, const SmallVector& vehicle_position);

}  // namespace incognita
