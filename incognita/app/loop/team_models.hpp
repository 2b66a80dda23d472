// From a team's scenario to its models: motions, sensors, noises, laws and paths.
#pragma once

#include <vector>

#include "incognita/control/team_controller.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/models/mount.hpp"
#include "incognita/models/terrain.hpp"
#include "incognita/slam/points/team_settings.hpp"
#include "incognita/world/carried_camera_world.hpp"
#include "incognita/world/points/team_world.hpp"

namespace incognita {

/// How many vehicles a scenario of points has.
std::size_t vehicles_of(const Scenario& scenario);

/// What vehicles stand on: level unless some know of uneven ground. Throws InputError, as terrain_of().
Terrain ground_of(const LoadedScenario& loaded);

AnyMotion motion_of(const Scenario& scenario, const Terrain& ground);
Mount mount_of(const Scenario& scenario);
AnySensor sensor_of(const Scenario& scenario);

/// What the filter believes of vehicle `i`.
TeamMember member_of(const Scenario& scenario, std::size_t i, const Terrain& ground);
TeamFilterSettings filter_of(const Scenario& scenario);

/// What vehicle `i` really is; of one that is carried the camera alone, the rest being carrier_of.
SimulatedVehicle simulated_vehicle(const Scenario& scenario, std::size_t i, const Terrain& ground);

/// What carries camera `i`, where has_carried_camera().
CameraCarrier carrier_of(const Scenario& scenario, std::size_t i, const Terrain& ground);

/// The point of a vehicle that its law brings to the path, before and left of the point that its state tells
/// (m).
Eigen::Vector2d steered_point(const Scenario& scenario);

/// Which way vehicle `i` is to go, and by which law. Throws InputError where a path's file cannot be used.
VehicleSteering steering_of(const LoadedScenario& loaded, std::size_t i, const Terrain& ground);

/// The landmarks, drawn or from a table. Throws InputError.
PointLandmarks point_landmarks_of(const LoadedScenario& loaded);

}  // namespace incognita
