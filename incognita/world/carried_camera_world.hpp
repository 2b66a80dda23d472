// Simulation of cameras carried by vehicles on uneven ground, where the filter estimates only the cameras:
// thesis Section 6.4.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/models/motion/mount.hpp"
#include "incognita/world/plant.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

struct CameraCarrier {
  TerrainVehicle vehicle;
  PlantSettings plant;  ///< inputs of the vehicle: speed, m/s, and turn rate, rad/s
  Mount mount;
};

/// Pose, velocity and angular rate of a camera on a moving vehicle: 13 numbers as in FreeCameraMotion.
/// `state_rate`: d(state of the vehicle)/dt.
FreeCameraMotion::State<double> carried_camera(const CameraCarrier& carrier,
                                               const TerrainVehicle::State<double>& state,
                                               const TerrainVehicle::State<double>& state_rate);

class CarriedCameraWorld final : public World {
 public:
  /// Throws std::invalid_argument as Plant does.
  CarriedCameraWorld(std::vector<CameraCarrier> carriers, std::uint64_t seed);

  /// Inputs: speed and turn rate of each carrier; a carrier without input stands still. The truth
  /// is that of the cameras; their inputs are 0, since their accelerations are not commanded.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  std::vector<CameraCarrier> carriers_;
  std::vector<Plant> plants_;
};

}  // namespace incognita
