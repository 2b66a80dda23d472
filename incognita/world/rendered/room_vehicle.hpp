// A vehicle on the uneven floor of the rendered room, that carries the camera: thesis Section 6.4.
#pragma once

#include <cstdint>
#include <memory>

#include "incognita/models/mount.hpp"
#include "incognita/models/terrain_vehicle.hpp"
#include "incognita/world/plant.hpp"
#include "incognita/world/rendered/floor_plan.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// Its input is the first of the command's `inputs`; none: it stands still. Where it would come nearer than
/// its radius to a wall or a box its wheels turn and it stays where it is.
class RoomVehicle final : public World {
 public:
  /// `plant`: of the vehicle, a TerrainVehicle's. Throws std::invalid_argument where the vehicle starts
  /// nearer than `radius_m` to a wall or a box, or where a number cannot be.
  RoomVehicle(const TerrainVehicle& body, const Mount& mount, const PlantSettings& plant,
              const RoomLayout& layout, double radius_m, std::uint64_t seed);

  /// The camera's pose and speeds, its state being `vehicles[0]` and what the wheels did `inputs[0]`.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  void stop_at_obstacles(const SmallVector& before);

  TerrainVehicle body_;
  Mount mount_;
  FloorPlan plan_;
  double radius_m_;
  Plant plant_;
  bool held_up_ = false;  ///< by an obstacle, in the tick before
};

/// Its camera, its wheels' speed and turn rate, and how far it is to what stands around.
class RoomVehicleSensor final : public Sensor {
 public:
  RoomVehicleSensor(RoomCamera camera, const RoomLayout& layout, const RangeRing& ring, std::uint64_t seed);

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  RoomCamera camera_;
  FloorPlan plan_;
  RangeRing ring_;
  RandomStream noise_;
};

}  // namespace incognita
