// Vehicle on the uneven floor of the rendered room, which carries the camera: thesis Section 6.4.
#pragma once

#include <cstdint>
#include <memory>

#include "incognita/models/motion/mount.hpp"
#include "incognita/models/motion/terrain_vehicle.hpp"
#include "incognita/world/plant.hpp"
#include "incognita/world/rendered/floor_plan.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// Its input is that of the first body; without one it stands still. If it would come closer
/// than its radius to a wall or a box, its wheels slip and it stays in position.
class RoomVehicle final : public World {
 public:
  /// `plant`: of the vehicle, a TerrainVehicle. Throws std::invalid_argument if the vehicle starts closer
  /// than `radius_m` to a wall or a box, or if a setting is invalid.
  RoomVehicle(const TerrainVehicle& body, const Mount& mount, const PlantSettings& plant,
              const RoomLayout& layout, double radius_m, std::uint64_t seed);

  /// Returns the state of the camera, that of the vehicle as its carrier, and the executed wheel input.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  void stop_at_obstacles(const SmallVector& before);

  TerrainVehicle body_;
  Mount mount_;
  FloorPlan plan_;
  double radius_m_;
  Plant plant_;
  bool held_up_ = false;  ///< blocked by an obstacle in the last tick
};

/// Camera image, wheel speeds (speed and turn rate) and proximity ranges.
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
