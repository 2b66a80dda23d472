// The low level of a vehicle that carries the camera: drives as it is told, or along a path, and keeps clear
// of what stands around it. Thesis Section 6.4.
#pragma once

#include <memory>
#include <optional>

#include "incognita/control/obstacle_avoidance.hpp"
#include "incognita/control/steering.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/goal.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/models/mount.hpp"
#include "incognita/slam/features/estimate.hpp"

namespace incognita {

/// The vehicle's place and heading seen from above, from its camera's.
planar::Pose<double> axle_under(const CameraState& camera, const Mount& mount);

struct VehicleDriving {
  SteeringSettings steering;  ///< of a TerrainVehicle; where a goal does not say how to drive
  Mount mount;
  std::optional<ObstacleAvoidanceSettings> obstacle_avoidance = {};
};

class VehicleController {
 public:
  /// `period_s`: how long a command is held. Throws std::invalid_argument as make_steering and ObstacleAvoidanceSettings do.
  VehicleController(const VehicleDriving& driving, double period_s);

  /// Before the start and when lost it stands still. A goal's `drive` comes before the law.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation, const Tick& tick);

 private:
  Eigen::Vector2d desired_drive(const Estimate& estimate, const Goal& goal, const Tick& tick);

  VehicleDriving driving_;
  std::unique_ptr<Steering> law_;
  std::optional<double> first_t_;
  TurnSide turn_side_ = TurnSide::none;
};

}  // namespace incognita
