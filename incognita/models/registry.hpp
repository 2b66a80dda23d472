// The one list of motion models and the one list of sensors. A model that is added here is offered in scenarios under
// its own name and tested like all others.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "incognita/models/arc_motion.hpp"
#include "incognita/models/camera_sensors.hpp"
#include "incognita/models/free_camera.hpp"
#include "incognita/models/held_acceleration.hpp"
#include "incognita/models/monobot.hpp"
#include "incognita/models/planar_vehicle.hpp"
#include "incognita/models/range_sensors.hpp"
#include "incognita/models/terrain_vehicle.hpp"

namespace incognita {

using AnyMotion =
    std::variant<MonobotMotion, DifferentialDrive, AckermannCar, TerrainVehicle, FreeCameraMotion>;
using AnySensor =
    std::variant<RelativePositionSensor, RangeBearingSensor, BearingSensor, CameraSensor, StereoSensor>;

/// with(Type) for each alternative of a variant, as a std::type_identity.
template <class Variant, class With>
constexpr void for_each_type(With&& with) {
  [&]<class... T>(std::type_identity<std::variant<T...>>) {
    (with(std::type_identity<T>{}), ...);
  }(std::type_identity<Variant>{});
}

/// The compiler names what a registered model lacks.
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

/// An entry of the list of motions or of sensors, with its parameters.
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

/// The words of vehicle.model and of run.sensor.
std::vector<std::string> motion_names();
std::vector<std::string> sensor_words();

/// Throw std::invalid_argument with the nearest name where there is none of that name.
AnyMotion make_motion(std::string_view name);
const MotionTraits& motion_traits_of(std::string_view name);
/// Of sensors that share the word the one that fits the motion; where none does, the one of that name.
AnySensor make_sensor(std::string_view word, const MotionTraits& motion);
const SensorTraits& sensor_traits_of(std::string_view word, const MotionTraits& motion);

/// Sets every parameter of a model to value(key, default), as `sensor_forward_m`.
template <class Variant, class Value>
void set_model_parameters(Variant& model, Value value) {
  std::visit([&](auto& alternative) { set_parameters(alternative, value); }, model);
}

/// The ground under a vehicle that needs one.
void set_terrain(AnyMotion& motion, const Terrain& terrain);
/// The lens of a camera and how it is mounted; nothing to other sensors.
void set_camera(AnySensor& sensor, const Camera& camera, const Mount& mount);

}  // namespace incognita
