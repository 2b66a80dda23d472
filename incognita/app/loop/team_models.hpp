// Builds the models of a team scenario: motions, sensors, noises, control laws and paths.
#pragma once

#include <vector>

#include "incognita/control/team_controller.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/models/mount.hpp"
#include "incognita/models/terrain.hpp"
#include "incognita/slam/mapper/settings.hpp"
#include "incognita/world/carried_camera_world.hpp"
#include "incognita/world/points/team_world.hpp"

namespace incognita {

/// Number of vehicles of a team scenario.
std::size_t vehicles_of(const Scenario& scenario);

/// The terrain; flat if no vehicle is modeled on uneven ground. Throws InputError as terrain_of().
Terrain ground_of(const LoadedScenario& loaded);

AnyMotion motion_of(const Scenario& scenario, const Terrain& ground);
Mount mount_of(const Scenario& scenario);
AnySensor sensor_of(const Scenario& scenario);

/// The estimator's model of vehicle `i`.
BodyModel member_of(const Scenario& scenario, std::size_t i, const Terrain& ground);
MapperSettings filter_of(const Scenario& scenario);

/// The true vehicle `i`; of a carried camera the camera only, see carrier_of().
SimulatedVehicle simulated_vehicle(const Scenario& scenario, std::size_t i, const Terrain& ground);

/// The carrier of camera `i` if has_carried_camera().
CameraCarrier carrier_of(const Scenario& scenario, std::size_t i, const Terrain& ground);

/// The point that the control law brings to the path, ahead and left of the vehicle's reference point, m.
Eigen::Vector2d steered_point(const Scenario& scenario);

/// Path and control law of vehicle `i`. Throws InputError if a path file cannot be used.
VehicleSteering steering_of(const LoadedScenario& loaded, std::size_t i, const Terrain& ground);

/// The landmarks, sampled or read from a table. Throws InputError.
PointLandmarks point_landmarks_of(const LoadedScenario& loaded);

}  // namespace incognita
