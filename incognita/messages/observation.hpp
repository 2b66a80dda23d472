// The measurements of one tick: all that the robots can know.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "incognita/math/small_matrix.hpp"
#include "incognita/models/motion/planar_twist.hpp"
#include "incognita/vision/image.hpp"

namespace incognita {

/// Odometry, held until the next reading.
struct Odometry {
  double t = 0;                     ///< s, on the clock of the ticks
  Eigen::Vector2d input{0.0, 0.0};  ///< as the vehicle's motion model takes it, e.g. m/s and rad/s
  /// Instead of the input, from odometry that tells how far the body moved, and how well it knows that
  std::optional<MeasuredTwist> twist = {};
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
  int sensor = 0;             ///< which of the body's point sensors
};

/// All that one body measures by itself; it may carry any set of sensors.
struct BodyObservation {
  /// One per camera of the body: immutable, shared with the record; null or missing without an image
  std::vector<std::shared_ptr<const Image>> images = {};
  /// The input that it executed since the last tick, as its motion model takes it
  std::optional<SmallVector> input = {};
  /// Or each reading since then, in time order. Of a free camera: the wheel encoders of the vehicle that carries it,
  /// speed, m/s, and turn rate, rad/s
  std::vector<Odometry> odometry = {};
  std::vector<PositionReading> fixes = {};     ///< of an external sensor, since the last tick, in time order
  std::vector<PointDetection> landmarks = {};  ///< of this tick
  std::vector<PointDetection> vehicles = {};   ///< other bodies of the team, of this tick
  std::vector<ConeRange> proximity_ranges = {};  ///< of obstacles, of this tick
};

/// The image of a camera of the body; null without one.
inline std::shared_ptr<const Image> image_of(const BodyObservation& body, std::size_t camera = 0) {
  return camera < body.images.size() ? body.images[camera] : nullptr;
}

/// All that the robots can know at one tick: one entry per body, in their order.
struct Observation {
  std::vector<BodyObservation> bodies;
};

/// The observation of a body; an empty one where there is none.
inline const BodyObservation& body_of(const Observation& observation, std::size_t body) {
  static const BodyObservation nothing;
  return body < observation.bodies.size() ? observation.bodies[body] : nothing;
}

}  // namespace incognita
