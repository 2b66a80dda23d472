// What a sensor states about itself, and what it must offer: docs/add-a-sensor.md.
//
// A sensor measures points from its own pose, which any_sensor.hpp makes of the vehicle's: the position on a line, the
// planar pose, or the pose of a mounted camera in space. Points have as many numbers as the sensor has dimensions. A
// sensor that does not measure distance initializes landmarks with an inverse depth, which become points later.
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "incognita/math/chart.hpp"
#include "incognita/math/small_matrix.hpp"
#include "incognita/models/motion_model.hpp"
#include "incognita/models/quantity.hpp"

namespace incognita {

/// How a landmark is told.
struct LandmarkParametrization {
  enum class Kind { point, inverse_depth };
  Kind kind = Kind::point;
  Eigen::Vector4d initial_axes{1, 0, 0,
                               0};  ///< of an inverse depth in space: world_from_initial_camera, a constant
};

struct AnyPrediction {
  SmallVector z;
  SmallMatrix Hv;       ///< rows x errors of the vehicle
  SmallMatrix Hl;       ///< rows x errors of the landmark
  bool in_view = true;  ///< of a camera: whether its image has the pixel
};

struct AnyInitialization {
  LandmarkParametrization form;
  Chart chart;
  SmallVector landmark;
  SmallMatrix Jv;  ///< d(landmark error) / d(vehicle error)
  SmallMatrix Jz;  ///< d(landmark error) / d(measurement)
  SmallVector Jd;  ///< d(landmark error) / d(inverse depth); none where the sensor measures distance
};

/// How far and how wide a sensor measures; a camera measures what its image has.
struct SensorLimits {
  double max_range_m = 1e9;
  double field_of_view_rad = 7;  ///< of a scanner, about straight ahead; 7 is more than a full turn
};

/// Why sensors of a plane or of space are not for vehicles on a line.
inline constexpr std::string_view line_needs_relative_position =
    "a vehicle on a line sees how far along it a point is, and nothing else: a bearing says nothing there, and an "
    "image has one column";

/// What a sensor states about itself, for code that does not care which sensor it is.
struct SensorTraits {
  std::string_view name;     ///< unique
  std::string_view word;     ///< of run.sensor; sensors of different spaces may share one
  std::string_view summary;  ///< one sentence
  int dimensions = 2;        ///< numbers of a point
  std::span<const Quantity> measurement;
  bool measures_distance = true;
  LandmarkParametrization::Kind initial_form = LandmarkParametrization::Kind::point;  ///< of a new landmark

  bool measures(std::string_view kind) const {
    for (const Quantity& quantity : measurement)
      if (quantity.name == kind || quantity.kind == kind) return true;
    return false;
  }
};

/// A sensor that a scenario can choose. `S::Pose` is where it measures from: its position on a line, planar::Pose, or
/// MountedPose in space; sensors in space have a `mount`. Jacobians are with respect to the error of that pose; for a
/// MountedPose they are with respect to the error of the vehicle. Optional: `static constexpr auto parameters()`, what a
/// scenario may set (quantity.hpp); `Camera& lens()`, which is set from outside.
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
  /// Why it cannot be on a vehicle; empty when it can.
  { S::incompatibility(motion) } -> std::convertible_to<std::string>;
  /// Nothing where the sensor has no measurement, as behind a camera.
  { sensor.predict_measurement(pose, form, landmark) } -> std::same_as<std::optional<AnyPrediction>>;
  /// `inverse_depth` (1/m): the mean before anything is known. Nothing where no point can be made of z.
  { sensor.initialize(pose, z, inverse_depth) } -> std::same_as<std::optional<AnyInitialization>>;
  /// Whether a prediction is inside the field of view.
  { sensor.in_field_of_view(prediction, sensor_limits) } -> std::same_as<bool>;
  /// Whether the sensor can give such numbers, noise included.
  { sensor.is_possible(z) } -> std::same_as<bool>;
};

template <SensorModel S>
inline constexpr SensorTraits sensor_traits{
    S::name, S::word, S::summary, S::dimensions, S::measurement, S::measures_distance, S::initial_form};

}  // namespace incognita
