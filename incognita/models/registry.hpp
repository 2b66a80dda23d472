// The lists of all motion models and sensors. A registered model is available in scenarios under its name and
// covered by the generic tests.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "incognita/models/motion/arc_motion.hpp"
#include "incognita/models/motion/free_camera.hpp"
#include "incognita/models/motion/held_acceleration.hpp"
#include "incognita/models/motion/monobot.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"
#include "incognita/models/sensors/camera_sensors.hpp"
#include "incognita/models/sensors/range_sensors.hpp"

namespace incognita {

using AnyMotion =
    std::variant<MonobotMotion, DifferentialDrive, AckermannCar, TerrainVehicle, FreeCameraMotion>;
using AnySensor =
    std::variant<RelativePositionSensor, RangeBearingSensor, BearingSensor, CameraSensor, StereoSensor>;

/// Calls with(std::type_identity<T>) for each alternative T of a variant.
template <class Variant, class With>
constexpr void for_each_type(With&& with) {
  [&]<class... T>(std::type_identity<std::variant<T...>>) {
    (with(std::type_identity<T>{}), ...);
  }(std::type_identity<Variant>{});
}

/// Checks of the concepts: the compiler names what a registered model lacks.
template <MotionModel... M>
constexpr bool are_motions(std::type_identity<std::variant<M...>>) {
  return true;
}
template <SensorModel... S>
constexpr bool are_sensors(std::type_identity<std::variant<S...>>) {
  return true;
}
static_assert(are_motions(std::type_identity<AnyMotion>{}));
static_assert(are_sensors(std::type_identity<AnySensor>{}));

/// Entries of the lists, with their parameters.
struct MotionEntry {
  MotionTraits traits;
  std::vector<ParameterInfo> parameters;
};
struct SensorEntry {
  SensorTraits traits;
  std::vector<ParameterInfo> parameters;
};
const std::vector<MotionEntry>& registered_motions();
const std::vector<SensorEntry>& registered_sensors();

/// The values of vehicle.model and sensor.type.
std::vector<std::string> motion_names();
std::vector<std::string> sensor_words();

/// Both throw std::invalid_argument, with the nearest name, when the name is unknown.
AnyMotion make_motion(std::string_view name);
const MotionTraits& motion_traits_of(std::string_view name);
/// Among sensors that share the word: the one compatible with the motion; if none is, the one of that name.
/// Both throw std::invalid_argument, with the nearest word, when the word is unknown.
AnySensor make_sensor(std::string_view word, const MotionTraits& motion);
const SensorTraits& sensor_traits_of(std::string_view word, const MotionTraits& motion);

/// Sets every parameter of a model to value(key, default); keys are e.g. `sensor_forward_m`.
template <class Variant, class Value>
void set_model_parameters(Variant& model, Value value) {
  std::visit([&](auto& alternative) { set_parameters(alternative, value); }, model);
}

/// Sets the terrain of a motion model that has one.
void set_terrain(AnyMotion& motion, const Terrain& terrain);
/// Sets projection model and mount of a camera; no effect on other sensors.
void set_camera(AnySensor& sensor, const Camera& camera, const Mount& mount);

}  // namespace incognita
