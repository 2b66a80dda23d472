// Sensors chosen by the scenario, on vehicles chosen by the scenario: measurement prediction and landmark
// initialization.
#pragma once

#include <optional>
#include <string>

#include "incognita/models/any_motion.hpp"
#include "incognita/models/registry.hpp"

namespace incognita {

/// Static properties of the sensor.
const SensorTraits& traits_of(const AnySensor& sensor);

/// The reason why the sensor cannot be used on the vehicle; empty when it can.
std::string incompatibility(const AnyMotion& motion, const AnySensor& sensor);

const Chart& chart_of(const AnySensor& sensor);  ///< of the measurement
int dimensions_of(const AnySensor& sensor);      ///< coordinates of a point
bool measures_distance(const AnySensor& sensor);

/// Nothing when the sensor cannot measure the landmark, e.g. behind a camera. Requires compatible motion and sensor.
std::optional<AnyPrediction> predict_measurement(const AnySensor& sensor, const AnyMotion& motion,
                                                 const SmallVector& vehicle,
                                                 const LandmarkParametrization& form,
                                                 const SmallVector& landmark);

/// Whether a point at `distance_m`, with this prediction, is within range and field of view.
bool is_in_view(const AnySensor& sensor, const SensorLimits& sensor_limits, const AnyPrediction& prediction,
                double distance_m);

/// Whether the sensor can output these numbers, noise included.
bool is_possible(const AnySensor& sensor, const SmallVector& z);

/// Landmark initialization from a measurement. `inverse_depth` (1/m): prior mean for sensors without range.
/// Nothing when the measurement does not define a point.
std::optional<AnyInitialization> initialize_landmark(const AnySensor& sensor, const AnyMotion& motion,
                                                     const SmallVector& vehicle, const SmallVector& z,
                                                     double inverse_depth);

/// Euclidean position of a landmark. Nothing at infinity, for a negative inverse depth, or for a ray.
std::optional<AnyPoint> position_of(const LandmarkParametrization& form, const SmallVector& landmark);
/// Linearity index (Civera et al. 2008): below about 0.1 the point parametrization is adequate. 0 for a
/// point. `vehicle_position`: in the dimensions of the landmark's position.
double linearity_index(const LandmarkParametrization& form, const SmallVector& landmark,
                       double inverse_depth_var, const SmallVector& vehicle_position);

}  // namespace incognita
