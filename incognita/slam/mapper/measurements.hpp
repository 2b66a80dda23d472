// Linearized measurements of landmarks, anchors and other bodies, and landmark initialization.
#pragma once

#include <optional>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

struct LinearizedDetection {
  LinearizedMeasurement linearized;
  SmallVector predicted;
  /// False for a landmark of unknown depth that is seen from far beside the ray of its initialization: the second-order
  /// term of the measurement over one sigma of the inverse depth exceeds its noise, and it must not correct the filter.
  bool is_linear = true;
};

/// The sensor that made a detection. Throws std::out_of_range when the body has no such sensor.
const PointSensor& sensor_of(const EstimatorSettings& settings, int body, int sensor);

/// Covariance R of a measurement.
SmallMatrix detection_noise(const PointSensor& sensor, const SmallVector& z);

/// Whether a sensor can measure a landmark: its points have as many coordinates, no camera tracks it, and it is no ray.
bool is_measurable(const Landmark& landmark, const AnySensor& sensor);

/// The predicted measurement of a landmark or anchor within range and field of view of a point sensor; nothing outside.
std::optional<SmallVector> predict_in_view(const Estimate& estimate, const Landmark& landmark, int body,
                                           int sensor, const EstimatorSettings& settings);

/// Linearizes a detection by `body` of an anchor, a mapped landmark or (`of_body`) another body.
/// The Jacobians are taken at the belief's means or, for first-estimate Jacobians, at the first estimates.
/// Nothing when the sensor cannot measure the predicted point, when the landmark is not mapped, or when the
/// other body is too close for a first-order model.
std::optional<LinearizedDetection> linearize_detection(const Estimate& estimate, int body, bool of_body,
                                                       const PointDetection& detection,
                                                       const EstimatorSettings& settings);

/// A position fix of a body (world, m), linearized at the belief's means.
LinearizedMeasurement linearized_fix(const Estimate& estimate, std::size_t body, const Eigen::Vector2d& fix,
                                     const EstimatorSettings& settings);

/// The measured point in the map frame, from the current mean of the body; nothing when the measurement is
/// not usable (not finite, or no positive range) or the sensor measures no distance.
std::optional<SmallVector> point_of(const Estimate& estimate, int body, const PointDetection& detection,
                                    const EstimatorSettings& settings);

/// Position of an anchor (world, m) in the map frame.
SmallVector anchor_position(const Estimate& estimate, const SmallVector& anchor);

/// Whether a measurement is finite, of the right size, and its range, if the sensor has one, positive.
bool is_usable(const AnySensor& sensor, const SmallVector& z);

/// Sets residual and noise for another measurement of the same point; prediction and Jacobians are kept.
void set_residual(LinearizedDetection& measurement, const PointSensor& sensor, const SmallVector& z);

}  // namespace incognita
