#include "incognita/app/loop/assemble_room_vehicle.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "incognita/app/loop/assemble.hpp"
#include "incognita/app/loop/team_models.hpp"
#include "incognita/control/vehicle_controller.hpp"
#include "incognita/decision/camera_decision.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/world/rendered/room_vehicle.hpp"
#include "incognita/world/room_clock.hpp"

namespace incognita {
namespace {

/// The room places no boxes between its target and the initial camera position.
RoomSettings room_of(const Scenario& s) {
  RoomSettings room = s.room;
  const Eigen::Vector3d& start = s.team_start.positions_m.front();
  room.start_position_m = {start.x(), start.y(), s.mount.up_m};
  return room;
}

WheelOdometry odometry_of(const Scenario& s) {
  const VehicleSettings& v = s.planar.vehicle;
  return {mount_of(s), v.sigma_speed_m_s, v.sigma_turn_rate_rad_s, s.slam.filter.sigma_slip_m_s};
}

VehicleDriving driving_of(const LoadedScenario& loaded, const Terrain& ground) {
  constexpr double to_spare_m = 0.05;  // margin for range and wheel errors
  const Scenario& s = loaded.scenario;
  VehicleDriving driving{steering_of(loaded, 0, ground).settings, mount_of(s)};
  if (s.controller.avoidance_distance_m > 0)
    driving.obstacle_avoidance =
        ObstacleAvoidanceSettings{s.controller.avoidance_distance_m,
                                  s.room.clearance_m + to_spare_m,
                                  {s.controller.max_speed_m_s, s.controller.max_turn_rate_rad_s}};
  return driving;
}

std::unique_ptr<Controller> controller_of(const LoadedScenario& loaded, const Terrain& ground) {
  const Scenario& s = loaded.scenario;
  try {
    return std::make_unique<VehicleController>(driving_of(loaded, ground), 1 / s.run.rate_hz);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: controller.law = {}: {}", loaded.source_of("controller.law"),
                                 word_of(s.controller.law), error.what()));
  }
}

std::unique_ptr<Strategy> decision_of(const Scenario& s, const Camera& camera) {
  if (!s.decides()) return std::make_unique<NoDecision>();
  const ControllerSettings& can = s.controller;
  const CarrierSettings carrier{mount_of(s), can.max_speed_m_s, can.max_turn_rate_rad_s};
  return std::make_unique<CameraDecision>(camera, s.slam, s.decision, s.exploration,
                                          static_cast<std::uint64_t>(s.run.seed), carrier);
}

RoomVehicleAssembly assembled(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  const Camera camera = make_camera(s.camera);
  std::optional<Target> target;
  if (s.start.from == StartSettings::From::target) target = load_target(loaded);
  const bool scale_is_known = target.has_value();
  const Terrain ground = ground_of(loaded);
  const auto room = std::make_shared<const Room>(room_of(s), seed, ground);
  if (target) check_sheet(loaded, *target, room->layout().sheet);
  std::optional<WheelOdometry> odometry;
  if (s.slam.filter.odometry) odometry = odometry_of(s);
  auto world = std::make_unique<RoomVehicle>(TerrainVehicle{ground}, mount_of(s),
                                             simulated_vehicle(s, 0, ground).plant, room->layout(),
                                             s.room.clearance_m, seed);
  auto sensor = std::make_unique<RoomVehicleSensor>(RoomCamera(room, camera, s.room, seed), room->layout(),
                                                    RangeRing{}, seed);
  return {
      {std::make_unique<FixedRateClock>(s.run.rate_hz, s.run.duration_s), std::move(world), std::move(sensor),
       std::make_unique<SlamEstimator>(
           single_camera(camera, target, s.slam, s.start.max_search_s, seed, odometry)),
       decision_of(s, camera), controller_of(loaded, ground)},
      scale_is_known};
}

}  // namespace

RoomVehicleAssembly assemble_room_vehicle(const LoadedScenario& loaded) {
  try {
    return assembled(loaded);
  } catch (const std::invalid_argument& error) {
    throw InputError(shown(loaded.file) + ": " + error.what());
  }
}

}  // namespace incognita
