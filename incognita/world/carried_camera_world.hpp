// Cameras that are carried by vehicles on uneven ground, while what is estimated is a camera alone: thesis
// Section 6.4.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/models/mount.hpp"
#include "incognita/world/plant.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

struct CameraCarrier {
  TerrainVehicle vehicle;
  PlantSettings plant;  ///< of the vehicle: speed, m/s, and turn rate, rad/s
  Mount mount;
};

/// Pose, velocity and angular rate of a camera on a vehicle that moves: 13 numbers as of FreeCameraMotion.
/// `state_rate`: d(state of the vehicle)/dt.
FreeCameraMotion::State<double> carried_camera(const CameraCarrier& carrier,
                                               const TerrainVehicle::State<double>& state,
                                               const TerrainVehicle::State<double>& state_rate);

class CarriedCameraWorld final : public World {
 public:
  /// Throws std::invalid_argument as Plant does.
  CarriedCameraWorld(std::vector<CameraCarrier> carriers, std::uint64_t seed);

  /// `command.inputs`: a speed and a turn rate for each carrier; without one it stands. The truth is of the
  /// cameras; their inputs are 0, for nobody commands their accelerations.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  std::vector<CameraCarrier> carriers_;
  std::vector<Plant> plants_;
};

}  // namespace incognita
