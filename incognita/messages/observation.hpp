// Sensor readings of the robot at one tick.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

/// Wheel odometry, held until the next reading.
struct Odometry {
  double t = 0;                     ///< s, on the clock of the ticks
  Eigen::Vector2d input{0.0, 0.0};  ///< as the vehicle's motion model takes it, e.g. m/s and rad/s
};

/// Position of the vehicle, measured by an external sensor.
struct PositionReading {
  double t = 0;                        ///< s, on the clock of the ticks
  Eigen::Vector2d position{0.0, 0.0};  ///< world, m
};

/// A detected landmark as range and bearing in the sensor frame.
struct Detection {
  static constexpr std::int64_t unknown = -1;
  double range_m = 0;
  double bearing_rad = 0;           ///< from straight ahead, positive to the left
  std::int64_t identity = unknown;  ///< landmark identity, if the sensor provides one
};

/// Distance to the nearest obstacle inside a cone, e.g. of a sonar; the obstacle is not identified.
struct ConeRange {
  double bearing_rad = 0;     ///< of the cone axis, from the vehicle's forward axis, positive to the left
  double half_width_rad = 0;  ///< half opening angle of the cone
  double range_m = 0;         ///< from the center of the axle; the maximum range when nothing is detected
};

/// True for a finite range above 0 and a finite bearing.
inline bool is_usable(const Detection& detection) {
  return std::isfinite(detection.range_m) && detection.range_m > 0 && std::isfinite(detection.bearing_rad);
}

/// Raw measurement of a point, with identity if the sensor provides one.
struct PointDetection {
  std::int64_t identity = 0;  ///< landmark or Detection::unknown; for another vehicle its index, from 0
  SmallVector z;              ///< in the coordinates of the sensor model
};

/// Onboard readings of one vehicle of a team.
struct VehicleObservation {
  std::optional<SmallVector> input;  ///< executed since the previous tick, in the motion model's convention
  std::vector<Odometry> odometry;    ///< or all recorded readings since the previous tick, in order
  std::vector<PositionReading> fixes = {};  ///< of an external sensor, since the previous tick, in time order
  /// Encoder speed, m/s, and turn rate, rad/s, of the carrier of a camera. The filter does not use them.
  std::optional<Eigen::Vector2d> wheels;
  std::vector<PointDetection> landmarks;  ///< of this tick
  std::vector<PointDetection> vehicles;   ///< other team members detected in this tick
};

struct Observation {
  std::shared_ptr<const Image> image;    ///< shared with the recorder; null without a frame
  std::vector<Odometry> odometry;        ///< of the camera's carrier, since the previous tick, in time order
  std::vector<VehicleObservation> team;  ///< one per vehicle that detects points
  std::vector<ConeRange> proximity_ranges;  ///< distances to obstacles around a vehicle, of this tick
};

}  // namespace incognita
