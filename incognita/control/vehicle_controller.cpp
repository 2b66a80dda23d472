#include "incognita/control/vehicle_controller.hpp"

#include <cmath>
#include <stdexcept>

namespace incognita {

planar::Pose<double> axle_under(const CameraState& camera, const Mount& mount) {
  const Eigen::Matrix3d world_from_body =
      rotation_matrix<double>(free_camera::orientation(camera)) * mount.body_from_camera().transpose();
  const Eigen::Vector3d axle = free_camera::position(camera) - world_from_body * mount.lever();
  return {axle.x(), axle.y(), std::atan2(world_from_body(1, 0), world_from_body(0, 0))};
}

VehicleController::VehicleController(const VehicleDriving& driving, double period_s)
    : driving_(driving), law_(make_steering(TerrainVehicle{}, driving.steering, period_s)) {
  if (driving_.obstacle_avoidance) driving_.obstacle_avoidance->check();
  if (driving_.steering.most_input.size() != TerrainVehicle::input_size)
    throw std::invalid_argument("a vehicle needs the limits of its speed and turn rate");
}

Eigen::Vector2d VehicleController::desired_drive(const Estimate& estimate, const Goal& goal,
                                                 const Tick& tick) {
  if (goal.drive) return *goal.drive;
  return law_->act(axle_under(estimate.camera_state(), driving_.mount), tick.t - *first_t_);
}

Command VehicleController::act(const Estimate& estimate, const Goal& goal, const Observation& observation,
                               const Tick& tick) {
  if (!first_t_) first_t_ = tick.t;
  Command command;
  Eigen::Vector2d drive(0, 0);
  if (estimate.started && estimate.status.state != TrackingState::lost) {
    const SmallVector& most = driving_.steering.most_input;
    drive = limited(desired_drive(estimate, goal, tick), {most[0], most[1]}).input();
    if (driving_.obstacle_avoidance) {
      const AvoidanceCommand clear = avoid_obstacles(drive, of_first_body(observation).proximity_ranges,
                                                     *driving_.obstacle_avoidance, turn_side_);
      drive = clear.drive;
      turn_side_ = clear.turn_side;
    }
  }
  command.inputs.emplace_back(drive);
  return command;
}

}  // namespace incognita
