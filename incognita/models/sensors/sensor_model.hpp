// Static properties and required interface of a sensor: docs/add-a-sensor.md.
//
// A sensor measures points from its own pose, which any_sensor.cpp computes from that of the vehicle: the
// position on a line, the planar pose, or the pose of a mounted camera in space. Points have as many
// coordinates as the sensor has dimensions. A sensor without range initializes landmarks with an inverse
// depth, which are converted to points when they have converged.
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "incognita/math/chart.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/motion/motion_model.hpp"
#include "incognita/models/motion/quantity.hpp"

namespace incognita {

/// Parametrization of a landmark.
struct LandmarkParametrization {
  enum class Kind {
    point,
    inverse_depth,
    ray,  ///< an inverse-depth landmark without its depth
  };
  Kind kind = Kind::point;
  Eigen::Vector4d initial_axes{1, 0, 0, 0};  ///< world_from_initial_camera, constant; inverse depth only
};

struct AnyPrediction {
  SmallVector z;
  SmallMatrix Hv;       ///< rows x errors of the vehicle
  SmallMatrix Hl;       ///< rows x errors of the landmark
  bool in_view = true;  ///< camera only: whether the pixel is in the image
};

struct AnyInitialization {
  LandmarkParametrization form;
  Chart chart;
  SmallVector landmark;
  SmallMatrix Jv;  ///< d(landmark error) / d(vehicle error)
  SmallMatrix Jz;  ///< d(landmark error) / d(measurement)
  SmallVector Jd;  ///< d(landmark error) / d(inverse depth); empty for sensors with range
};

/// Range and field of view of a sensor; a camera is limited by its image instead.
struct SensorLimits {
  double max_range_m = 1e9;
  double field_of_view_rad = 7;  ///< scanners: total angle, centered straight ahead; 7 exceeds a full turn
};

/// Why sensors of a plane or of space cannot be used on a line.
inline constexpr std::string_view line_needs_relative_position =
    "a vehicle on a line measures only where a point is along the line: there a bearing has no information, and an image "
    "one column";

/// Static properties of a sensor, for code independent of its type.
struct SensorTraits {
  std::string_view name;     ///< unique
  std::string_view word;     ///< value of sensor.type; sensors of different spaces may share it
  std::string_view summary;  ///< one sentence
  int dimensions = 2;        ///< coordinates of a point
  std::span<const Quantity> measurement;
  bool measures_distance = true;
  LandmarkParametrization::Kind initial_form = LandmarkParametrization::Kind::point;  ///< of a new landmark

  bool measures(std::string_view kind) const {
    for (const Quantity& quantity : measurement)
      if (quantity.name == kind || quantity.kind == kind) return true;
    return false;
  }
};

/// A sensor that a scenario can choose. `S::Pose` is the pose it measures from: the position on a line, planar::Pose,
/// or MountedPose in space; sensors in space have a `mount`. Jacobians are with respect to the error of that pose;
/// for a MountedPose, with respect to the error of the vehicle. Optional members: `static constexpr auto
/// parameters()`, settable by the scenario (quantity.hpp); `Camera& lens()`, set by set_camera().
template <class S>
concept SensorModel = requires(const S& sensor, const typename S::Pose& pose,
                               const LandmarkParametrization& form, const SmallVector& landmark,
                               const SmallVector& z, const AnyPrediction& prediction,
                               const SensorLimits& sensor_limits, double inverse_depth,
                               const MotionTraits& motion) {
  requires std::default_initializable<S>;
  { S::name } -> std::convertible_to<std::string_view>;
  { S::word } -> std::convertible_to<std::string_view>;
  { S::summary } -> std::convertible_to<std::string_view>;
  { S::dimensions } -> std::convertible_to<int>;
  { S::measures_distance } -> std::convertible_to<bool>;
  { S::initial_form } -> std::convertible_to<LandmarkParametrization::Kind>;
  { S::chart } -> std::convertible_to<const Chart&>;
  requires S::measurement.size() == S::chart.tangent();
  /// The reason why it cannot be used on a vehicle; empty when it can.
  { S::incompatibility(motion) } -> std::convertible_to<std::string>;
  /// Nothing when the sensor cannot measure the landmark, e.g. behind a camera.
  { sensor.predict_measurement(pose, form, landmark) } -> std::same_as<std::optional<AnyPrediction>>;
  /// `inverse_depth` (1/m): prior mean for sensors without range. Nothing when z does not define a point.
  { sensor.initialize(pose, z, inverse_depth) } -> std::same_as<std::optional<AnyInitialization>>;
  /// Whether a prediction is inside the field of view.
  { sensor.in_field_of_view(prediction, sensor_limits) } -> std::same_as<bool>;
  /// Whether the sensor can output these numbers, noise included.
  { sensor.is_possible(z) } -> std::same_as<bool>;
};

template <SensorModel S>
inline constexpr SensorTraits sensor_traits{
    S::name, S::word, S::summary, S::dimensions, S::measurement, S::measures_distance, S::initial_form};

}  // namespace incognita
