// Builds the models of a scenario: motions, sensors, noises, control laws and paths.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/control/body_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/mount.hpp"
#include "incognita/models/motion/terrain.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/settings.hpp"
#include "incognita/world/points/point_world.hpp"

namespace incognita {

/// Number of vehicles of a team scenario.
std::size_t vehicles_of(const Scenario& scenario);

/// The terrain; flat if no vehicle is modeled on uneven ground. Throws InputError as terrain_of().
Terrain ground_of(const LoadedScenario& loaded);

AnyMotion motion_of(const Scenario& scenario, const Terrain& ground);
AnySensor sensor_of(const Scenario& scenario);

/// The estimator's model of vehicle `i`.
BodyModel member_of(const Scenario& scenario, std::size_t i, const Terrain& ground);
MapperSettings filter_of(const Scenario& scenario);
/// Nothing if landmarks enter the map at once.
std::optional<DepthLineSettings> depth_lines_of(const Scenario& scenario);

/// The true vehicle `i` with its point sensor; the vehicle that carries camera `i` if has_carried_camera().
SimulatedVehicle simulated_vehicle(const Scenario& scenario, std::size_t i, const Terrain& ground);

/// The point that the control law brings to the path, ahead and left of the vehicle's reference point, m.
Eigen::Vector2d steered_point(const Scenario& scenario);

/// Path and control law of vehicle `i`. Throws InputError if a path file cannot be used.
BodyControl body_control_of(const LoadedScenario& loaded, std::size_t i, const Terrain& ground);

/// The settings of the decision of all bodies.
ActiveSettings active_settings_of(const Scenario& scenario);

/// Names of a motion model's inputs, with units.
std::vector<std::string> input_names(const MotionTraits& motion);

/// The estimator of bodies that map by their point sensors. Throws InputError for a sensor that does not fit.
std::unique_ptr<SlamEstimator> point_estimator(const LoadedScenario& loaded,
                                               const EstimatorSettings& settings);

/// Attributes an exception of a component that names no setting to its most relevant one.
template <class Make>
auto attributed_to(const LoadedScenario& loaded, const std::string& key, const std::string& value,
                   const Make& make) {
  try {
    return make();
  } catch (const UnfitSetting&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw InputError(loaded.source_of(key) + ": " + key + " = " + value + ": " + error.what());
  }
}

/// The landmarks, sampled or read from a table. Throws InputError.
PointLandmarks point_landmarks_of(const LoadedScenario& loaded);

}  // namespace incognita
