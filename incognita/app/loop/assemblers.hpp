// The builders behind assemble(), one per world.
#pragma once

#include <memory>
#include <optional>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/control/obstacle_avoidance.hpp"
#include "incognita/models/sensors/camera.hpp"
#include "incognita/models/sensors/wheel_odometry.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {

/// The rendered room, with a free camera or a vehicle that carries it.
Assembly assemble_rendered(const LoadedScenario& loaded);
/// Recorded images.
Assembly assemble_recorded_images(const LoadedScenario& loaded);
/// A camera that takes its images now.
Assembly assemble_live_camera(const LoadedScenario& loaded, const LiveSources& sources);
/// Point landmarks, simulated.
Assembly assemble_points(const LoadedScenario& loaded);
/// A robot that is reached by rosbridge. Connects when the loop asks for the first image.
Assembly assemble_robot(const LoadedScenario& loaded);
/// Recorded ranges and bearings of one vehicle or of a team.
Assembly assemble_recorded_ranges(const LoadedScenario& loaded);

/// Sets what the recorder records of the scenario itself, whatever its world.
void put_scenario(const LoadedScenario& loaded, RunInfo& info);

/// The surveyed landmarks of a recording. `identified`: the map uses their identities.
Survey survey_of(const RangeRecording& recording, bool identified);

/// The target from which the camera starts, if any.
std::optional<Target> start_target(const LoadedScenario& loaded);
/// The estimator of one camera that maps by its images.
std::unique_ptr<SlamEstimator> image_estimator(const LoadedScenario& loaded, const Camera& camera,
                                               const std::optional<Target>& target,
                                               const std::optional<WheelOdometry>& odometry = {});

/// The estimator's model of the wheel odometry of the vehicle that carries the camera.
WheelOdometry wheel_odometry_of(const Scenario& scenario);
/// How the vehicle in the rendered room avoids obstacles; none if it does not.
std::optional<ObstacleAvoidanceSettings> obstacle_avoidance_of(const Scenario& scenario);

/// Checks that the target is at the position of the room's sheet, which depends on the room's size: otherwise
/// the start pose would be wrong and overconfident. Throws InputError.
void check_sheet(const LoadedScenario& loaded, const Target& target, const Sheet& sheet);

}  // namespace incognita
