// The bodies of the rendered room: a free camera, and a vehicle that carries one (thesis Section 6.4), which walls and
// boxes stop.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/world/rendered/floor_plan.hpp"
#include "incognita/world/rendered/room_layout.hpp"
#include "incognita/world/settings.hpp"
#include "incognita/world/simulated_world.hpp"

namespace incognita {

/// Walls and boxes that a free camera slides along.
class CameraObstacles final : public Obstacles {
 public:
  CameraObstacles(const RoomLayout& layout, double clearance_m);

  void check_start(const SmallVector& state) const override;
  bool stop(const SmallVector& before, SmallVector& state) const override;

 private:
  bool stop_at_box(const Box& box, const Eigen::Vector3d& before, SmallVector& state) const;

  Box inside_;              ///< admissible positions of the body's center
  std::vector<Box> boxes_;  ///< forbidden positions of the center
};

/// Walls and boxes that stop a vehicle `radius_m` away. Its wheels then slip: it may still turn in place, and move away.
class VehicleObstacles final : public Obstacles {
 public:
  VehicleObstacles(const RoomLayout& layout, double radius_m) : plan_(layout), radius_m_(radius_m) {}

  void check_start(const SmallVector& state) const override;
  bool stop(const SmallVector& before, SmallVector& state) const override;

 private:
  FloorPlan plan_;
  double radius_m_;
};

/// A free camera without an operator; its start is drawn. Its accelerations are not limited. Throws
/// std::invalid_argument for invalid sigmas or a nominal start outside the room.
SimulatedBody camera_in_room(const RoomSettings& settings, const RoomLayout& layout, std::uint64_t seed);

/// A vehicle with a camera. `plant`: its inputs are speed, m/s, and turn rate, rad/s.
SimulatedBody vehicle_in_room(const TerrainVehicle& vehicle, const Mount& mount, const PlantSettings& plant,
                              const RoomLayout& layout, double radius_m);

}  // namespace incognita
