#include <algorithm>
#include <memory>
#include <utility>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/operator_assembly.hpp"
#include "incognita/app/loop/room_map_truth.hpp"
#include "incognita/app/loop/room_motion.hpp"
#include "incognita/app/loop/world_outline.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/world/fixed_rate_clock.hpp"
#include "incognita/world/rendered/proximity_ring.hpp"
#include "incognita/world/rendered/room_bodies.hpp"
#include "incognita/world/rendered/room_camera.hpp"

namespace incognita {
namespace {

/// The room places no boxes between its target and the initial camera position.
RoomSettings room_of(const Scenario& s) {
  RoomSettings room = s.room;
  const Eigen::Vector3d& start = s.team_start.positions_m.front();
  room.start_position_m = {start.x(), start.y(), s.mount.up_m};
  return room;
}

/// Of the vehicle that carries the camera.
BodyControl carrier_control(const LoadedScenario& loaded, const Terrain& ground) {
  const Scenario& s = loaded.scenario;
  BodyControl control = body_control_of(loaded, 0, ground);
  control.carried_at = s.mount;
  control.obstacle_avoidance = obstacle_avoidance_of(s);
  return control;
}

std::unique_ptr<Controller> carrier_controller(const LoadedScenario& loaded, const Terrain& ground) {
  const Scenario& s = loaded.scenario;
  return attributed_to(loaded, "controller.law", word_of(s.controller.law), [&] {
    return std::make_unique<SteeringController>(std::vector{carrier_control(loaded, ground)},
                                                1 / s.run.rate_hz);
  });
}

/// The estimator and what decides by it.
void put_estimator(std::unique_ptr<SlamEstimator> estimator, const Scenario& s, LoopParts& parts) {
  if (s.decides() || !s.is_room_vehicle())
    parts.strategy = decide_for(*estimator, active_settings_of(s));
  else
    parts.strategy = std::make_unique<NoDecision>();
  parts.estimator = std::move(estimator);
}

std::unique_ptr<RoomCamera> room_camera(std::shared_ptr<const Room> room, const Camera& camera,
                                        const Scenario& s) {
  return std::make_unique<RoomCamera>(std::move(room), camera, s.room, static_cast<std::uint64_t>(s.run.seed),
                                      "sensor.image", s.exposure);
}

/// Evaluates the map, in the frame of the target. `cameras`: positions in the free space.
std::unique_ptr<MapTruth> room_truth_of(const std::shared_ptr<const Room>& room, const Camera& camera,
                                        const Scenario& s, const std::vector<Eigen::Vector3d>& cameras,
                                        PoseAtTime pose_at = {}) {
  return std::make_unique<RoomMapTruth>(SeenSurface(room, camera, s.exposure.readout_s, std::move(pose_at)),
                                        SurfacePatches(room, cameras));
}

/// A vehicle carries the camera.
void put_vehicle(const LoadedScenario& loaded, const Camera& camera, const std::optional<Target>& target,
                 Assembly& out) {
  LoopParts& parts = out.parts;
  const Scenario& s = loaded.scenario;
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  const Terrain ground = ground_of(loaded);
  const auto room = std::make_shared<const Room>(room_of(s), seed, ground);
  out.info.room = outline_of(room->layout());
  out.info.terrain =
      terrain_grid(ground, out.info.room->inside.min.head<2>(), out.info.room->inside.max.head<2>());
  if (target) check_sheet(loaded, *target, room->layout().sheet);
  parts.world = std::make_unique<SimulatedWorld>(
      vehicle_in_room({ground}, s.mount, simulated_vehicle(s, 0, ground).body.plant, room->layout(),
                      s.room.clearance_m),
      seed);
  parts.sensor = std::make_unique<SensorSet>(
      sensors_of_body(room_camera(room, camera, s), std::make_unique<WheelEncoders>(),
                      std::make_unique<ProximityRing>(room->layout(), RangeRing{}, seed)));
  if (target)
    parts.map_truth =
        room_truth_of(room, camera, s, carried_camera_positions(*room, s.mount, s.room.clearance_m));
  std::optional<WheelOdometry> odometry;
  if (s.slam.filter.odometry) odometry = wheel_odometry_of(s);
  put_estimator(image_estimator(loaded, camera, target, odometry), s, parts);
  parts.controller = carrier_controller(loaded, ground);
}

/// The camera follows a recorded motion. As with recorded images, the filter must not predict by any command.
void put_recorded_motion(const LoadedScenario& loaded, const Camera& camera,
                         const std::optional<Target>& target, Assembly& out) {
  LoopParts& parts = out.parts;
  const Scenario& s = loaded.scenario;
  const auto room = std::make_shared<const Room>(s.room, static_cast<std::uint64_t>(s.run.seed));
  out.info.room = outline_of(room->layout());
  if (target) check_sheet(loaded, *target, room->layout().sheet);
  const RoomMotion motion = motion_in_room(loaded, room->layout());
  for (const std::string& note : motion.notes) out.notes.push_back(note);
  parts.clock =
      std::make_unique<FixedRateClock>(s.run.rate_hz, std::max(motion.duration_s, 1 / s.run.rate_hz));
  parts.world = std::make_unique<ReplayWorld>(std::vector{truth_of(motion)});
  auto lens = room_camera(room, camera, s);
  const PoseAtTime pose_at = [spline = motion.world_from_camera](double t) { return spline->at(t).pose; };
  lens->follow(pose_at);
  if (target)
    parts.map_truth =
        room_truth_of(room, camera, s, free_camera_positions(*room, s.room.clearance_m), pose_at);
  parts.sensor = std::make_unique<SensorSet>(sensors_of_body(std::move(lens)));
  put_estimator(image_estimator(loaded, camera, target), s, parts);
  parts.controller = std::make_unique<SteeringController>();
}

/// The camera flies, or an operator holds it.
void put_free_camera(const LoadedScenario& loaded, const Camera& camera, const std::optional<Target>& target,
                     Assembly& out) {
  LoopParts& parts = out.parts;
  const Scenario& s = loaded.scenario;
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  const auto room = std::make_shared<const Room>(s.room, seed);
  out.info.room = outline_of(room->layout());
  if (target) check_sheet(loaded, *target, room->layout().sheet);
  SimulatedBody body = camera_in_room(s.room, room->layout(), seed);
  if (s.operator_settings.holds) body.actuator = operator_of(s, 0);
  parts.world = std::make_unique<SimulatedWorld>(std::move(body), seed);
  parts.sensor = std::make_unique<SensorSet>(sensors_of_body(room_camera(room, camera, s)));
  if (target)
    parts.map_truth = room_truth_of(room, camera, s, free_camera_positions(*room, s.room.clearance_m));
  put_estimator(image_estimator(loaded, camera, target), s, parts);
  parts.controller = std::make_unique<SteeringController>(
      std::vector{free_camera_control(s.control, s.operator_settings.holds)}, 1 / s.run.rate_hz);
}

}  // namespace

WheelOdometry wheel_odometry_of(const Scenario& s) {
  const VehicleSettings& v = s.planar.vehicle;
  return {s.mount, v.sigma_speed_m_s, v.sigma_turn_rate_rad_s, s.slam.filter.sigma_slip_m_s};
}

std::optional<ObstacleAvoidanceSettings> obstacle_avoidance_of(const Scenario& s) {
  constexpr double to_spare_m = 0.05;  // margin for range and wheel errors
  const ControllerSettings& c = s.controller;
  if (!(c.avoidance_distance_m > 0)) return std::nullopt;
  return ObstacleAvoidanceSettings{
      c.avoidance_distance_m, s.room.clearance_m + to_spare_m, {c.max_speed_m_s, c.max_turn_rate_rad_s}};
}

Assembly assemble_rendered(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const Camera camera = make_camera(s.camera);
  const std::optional<Target> target = start_target(loaded);
  Assembly out;
  put_scenario(loaded, out.info);
  out.info.ate_alignment = target ? "none" : "sim3";
  if (!s.has_recorded_motion())
    out.info.inputs = input_names(s.is_room_vehicle() ? motion_traits<TerrainVehicle> : s.motion());
  if (!target) out.notes.emplace_back("no target: the scale is unobservable, lengths are in arbitrary units");
  out.parts.clock = std::make_unique<FixedRateClock>(s.run.rate_hz, s.run.duration_s);
  if (s.is_room_vehicle())
    put_vehicle(loaded, camera, target, out);
  else if (s.has_recorded_motion())
    put_recorded_motion(loaded, camera, target, out);
  else
    put_free_camera(loaded, camera, target, out);
  return out;
}

}  // namespace incognita
