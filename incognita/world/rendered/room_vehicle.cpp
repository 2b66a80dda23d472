#include "incognita/world/rendered/room_vehicle.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace incognita {

RoomVehicle::RoomVehicle(const TerrainVehicle& body, const Mount& mount, const PlantSettings& plant,
                         const RoomLayout& layout, double radius_m, std::uint64_t seed)
    : body_(body), mount_(mount), plan_(layout), radius_m_(radius_m), plant_(body, plant, seed, "vehicle") {
  const double free_m = plan_.clearance_at(plant_.state().head<2>());
  if (free_m < radius_m)
    throw std::invalid_argument("the vehicle starts " + std::to_string(free_m) +
                                " m from a wall or a box, but needs " + std::to_string(radius_m) +
                                " m (room.clearance_m): move its start, or change room.boxes");
}

/// Blocks motion towards an obstacle. The vehicle may still turn in place, and move away.
void RoomVehicle::stop_at_obstacles(const SmallVector& before) {
  const double free_m = plan_.clearance_at(plant_.state().head<2>());
  held_up_ = free_m < radius_m_ && free_m < plan_.clearance_at(before.head<2>());
  if (held_up_) plant_.put(Eigen::Vector3d(before[0], before[1], plant_.state()[2]));
}

std::optional<Truth> RoomVehicle::move(const Command& command, const Tick& tick) {
  const SmallVector before = plant_.state();
  plant_.move(input_of(command, 0, TerrainVehicle::input_size), tick.dt);
  if (tick.dt > 0) stop_at_obstacles(before);
  const TerrainVehicle::State<double> x = plant_.state();
  TerrainVehicle::Input<double> u = plant_.in_force();
  if (held_up_) u[0] = 0;
  const MountedCamera<TerrainVehicle::error_size> mounted_pose = mount_.on(body_.pose(x));
  const Eigen::Matrix<double, 6, 1> speeds = mounted_pose.J * body_.rate<double>(x, u);
  Truth truth;
  BodyTruth& body = truth.bodies.emplace_back();
  body.state = mounted_pose.camera;
  body.state.tail<6>() = speeds;
  body.pose = pose_of(FreeCameraMotion{}, body.state);
  body.carrier = plant_.state();
  body.wheels = plant_.executed();
  return truth;
}

RoomVehicleSensor::RoomVehicleSensor(RoomCamera camera, const RoomLayout& layout, const RangeRing& ring,
                                     std::uint64_t seed)
    : camera_(std::move(camera)), plan_(layout), ring_(ring), noise_(seed, "vehicle.ranges") {}

Observation RoomVehicleSensor::measure(const std::optional<Truth>& truth, const Tick& tick) {
  Observation observation = camera_.measure(truth, tick);
  const BodyTruth& carried = truth->bodies.front();
  if (!carried.wheels) throw std::logic_error("RoomVehicleSensor: the truth has no vehicle");
  BodyObservation& body = observation.bodies.front();
  if (tick.dt > 0) body.odometry.push_back({tick.t, *carried.wheels});
  const SmallVector& x = carried.carrier;
  body.proximity_ranges = measure_ranges(plan_, ring_, x.head<2>(), x[2]);
  for (ConeRange& cone : body.proximity_ranges)
    if (cone.range_m < ring_.reach_m)
      cone.range_m = std::clamp(cone.range_m + ring_.sigma_m * noise_.normal(), 0.0, ring_.reach_m);
  return observation;
}

}  // namespace incognita
