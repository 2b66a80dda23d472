// Sensors of range and bearing for vehicles on a line and on a plane.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "incognita/models/motion/monobot.hpp"
#include "incognita/models/sensors/bearing.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/models/sensors/sensor_model.hpp"

namespace incognita {

/// The reason why a planar scanner cannot be used on a vehicle; empty when it can.
std::string incompatibility_of_scanner(const MotionTraits& motion);

/// Whether the bearing, the last number of a measurement, is within the field of view.
inline bool has_bearing_in_view(const AnyPrediction& prediction, const SensorLimits& sensor_limits) {
  return std::abs(prediction.z[prediction.z.size() - 1]) <= sensor_limits.field_of_view_rad / 2;
}

/// Position of a point on a line relative to the vehicle: thesis (3.6).
struct RelativePositionSensor {
  static constexpr std::string_view name = "relative-position", word = "range-bearing";
  static constexpr std::string_view summary = "position of a point on a line, relative to the vehicle";
  static constexpr int dimensions = 1;
  static constexpr std::array<Quantity, 1> measurement{{{"position", "m", "range"}}};
  static constexpr Chart chart = Chart::line(1);
  static constexpr bool measures_distance = true;
  static constexpr auto initial_form = LandmarkParametrization::Kind::point;
  using Pose = Eigen::Matrix<double, 1, 1>;

  static std::string incompatibility(const MotionTraits& motion);
  std::optional<AnyPrediction> predict_measurement(const Pose& pose, const LandmarkParametrization&,
                                                   const SmallVector& landmark) const;
  std::optional<AnyInitialization> initialize(const Pose& pose, const SmallVector& z, double) const;
  bool in_field_of_view(const AnyPrediction&, const SensorLimits&) const { return true; }
  bool is_possible(const SmallVector&) const { return true; }
};

/// Range and bearing: thesis (3.19).
struct RangeBearingSensor {
  static constexpr std::string_view name = "range-bearing", word = name;
  static constexpr std::string_view summary =
      "range and bearing of a point on a plane, as a laser scanner measures";
  static constexpr int dimensions = 2;
  static constexpr std::array<Quantity, 2> measurement{{{"range", "m"}, {"bearing", "rad"}}};
  static constexpr Chart chart = RangeBearing::chart;
  static constexpr bool measures_distance = true;
  static constexpr auto initial_form = LandmarkParametrization::Kind::point;
  using Pose = planar::Pose<double>;

  static std::string incompatibility(const MotionTraits& motion) {
    return incompatibility_of_scanner(motion);
  }
  std::optional<AnyPrediction> predict_measurement(const Pose& pose, const LandmarkParametrization&,
                                                   const SmallVector& landmark) const;
  std::optional<AnyInitialization> initialize(const Pose& pose, const SmallVector& z, double) const;
  bool in_field_of_view(const AnyPrediction& prediction, const SensorLimits& sensor_limits) const {
    return has_bearing_in_view(prediction, sensor_limits);
  }
  /// Noise can make a small range negative, which no scanner outputs.
  bool is_possible(const SmallVector& z) const { return z[0] > 0; }
};

/// Bearing only.
struct BearingSensor {
  static constexpr std::string_view name = "bearing", word = name;
  static constexpr std::string_view summary = "bearing of a point on a plane";
  static constexpr int dimensions = 2;
  static constexpr std::array<Quantity, 1> measurement{{{"bearing", "rad"}}};
  static constexpr Chart chart = Bearing::chart;
  static constexpr bool measures_distance = false;
  static constexpr auto initial_form = LandmarkParametrization::Kind::inverse_depth;
  using Pose = planar::Pose<double>;

  static std::string incompatibility(const MotionTraits& motion) {
    return incompatibility_of_scanner(motion);
  }
  std::optional<AnyPrediction> predict_measurement(const Pose& pose, const LandmarkParametrization& form,
                                                   const SmallVector& landmark) const;
  std::optional<AnyInitialization> initialize(const Pose& pose, const SmallVector& z,
                                              double inverse_depth) const;
  bool in_field_of_view(const AnyPrediction& prediction, const SensorLimits& sensor_limits) const {
    return has_bearing_in_view(prediction, sensor_limits);
  }
  bool is_possible(const SmallVector&) const { return true; }
};

}  // namespace incognita
