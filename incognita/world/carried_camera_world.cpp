#include "incognita/world/carried_camera_world.hpp"

#include <string>
#include <utility>

namespace incognita {

FreeCameraMotion::State<double> carried_camera(const CameraCarrier& carrier,
                                               const TerrainVehicle::State<double>& state,
                                               const TerrainVehicle::State<double>& state_rate) {
  const MountedCamera<3> mounted = carrier.mount.on(carrier.vehicle.pose(state));
  FreeCameraMotion::State<double> camera = mounted.camera;
  camera.tail<6>() = mounted.J * state_rate;  // velocity (world), and angular rate (camera axes)
  return camera;
}

CarriedCameraWorld::CarriedCameraWorld(std::vector<CameraCarrier> carriers, std::uint64_t seed)
    : carriers_(std::move(carriers)) {
  for (std::size_t i = 0; i < carriers_.size(); ++i)
    plants_.emplace_back(carriers_[i].vehicle, carriers_[i].plant, seed, "carrier." + std::to_string(i));
}

std::optional<Truth> CarriedCameraWorld::move(const Command& command, const Tick& tick) {
  Truth truth;
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    Plant& plant = plants_[i];
    plant.move(input_of(command, i, TerrainVehicle::input_size), tick.dt);
    BodyTruth& body = truth.bodies.emplace_back();
    body.state = carried_camera(carriers_[i], plant.state().head<3>(), plant.rate().head<3>());
    body.pose = pose_of(FreeCameraMotion{}, body.state);
    body.input = SmallVector::Zero(FreeCameraMotion::input_size);
    body.carrier = plant.state();
    body.wheels = plant.executed();
  }
  return truth;
}

}  // namespace incognita
