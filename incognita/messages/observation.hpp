// All that the robot can know at one tick: what its sensors gave.
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

/// What the wheels say, held until the next reading.
struct Odometry {
  double t = 0;                     ///< s, on the clock of the ticks
  Eigen::Vector2d input{0.0, 0.0};  ///< as the vehicle's motion model takes it, e.g. m/s and rad/s
};

/// Where an external sensor saw the vehicle, and when.
struct PositionReading {
  double t = 0;                        ///< s, on the clock of the ticks
  Eigen::Vector2d position{0.0, 0.0};  ///< world, m
};

/// A landmark as a laser or a camera with ranges gives it, in the frame of the sensor.
struct Detection {
  static constexpr std::int64_t unknown = -1;
  double range_m = 0;
  double bearing_rad = 0;           ///< from straight ahead, positive to the left
  std::int64_t identity = unknown;  ///< which landmark it is, where the sensor can tell
};

/// How far it is to the nearest thing inside a cone, as a sonar tells; what it is, it does not know.
struct ConeRange {
  double bearing_rad = 0;     ///< of the cone's middle, from the vehicle's forward axis, positive to the left
  double half_width_rad = 0;  ///< of the cone
  double range_m = 0;         ///< from the middle of the axle; the sensor's reach where there is nothing
};

/// Whether a detection is usable: finite, with a range above 0.
inline bool is_usable(const Detection& detection) {
  return std::isfinite(detection.range_m) && detection.range_m > 0 && std::isfinite(detection.bearing_rad);
}

/// What a sensor measured of a point, by name where it has one.
struct PointDetection {
  std::int64_t identity = 0;  ///< of a landmark, or Detection::unknown; of another vehicle which, from 0
  SmallVector z;              ///< as the sensor measures
};

/// What one vehicle of a team knows by itself.
struct VehicleObservation {
  std::optional<SmallVector>
      input;  ///< what it carried out since the tick before, as its motion model takes it
  std::vector<Odometry> odometry;  ///< or, where it was recorded, each reading since then, in time order
  std::vector<PositionReading> fixes = {};  ///< of an external sensor, since the tick before, in time order
  /// Speed, m/s, and turn rate, rad/s, by the encoders of what carries a camera; its filter does not ask
  std::optional<Eigen::Vector2d> wheels;
  std::vector<PointDetection> landmarks;  ///< of this very tick
  std::vector<PointDetection> vehicles;   ///< others of the team, of this very tick
};

struct Observation {
  std::shared_ptr<const Image>
      image;  ///< immutable, shared with the record; null when the camera gave nothing
  std::vector<Odometry>
      odometry;  ///< of the vehicle that carries that camera, since the tick before, in time order
  std::vector<VehicleObservation> team;     ///< of vehicles that detect points: one for each
  std::vector<ConeRange> proximity_ranges;  ///< what stands around a vehicle, of this very tick
};

}  // namespace incognita
