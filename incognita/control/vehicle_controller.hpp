// Low-level control of a vehicle that carries the camera: drives as the goal commands, or along a path, and
// avoids obstacles. Thesis Section 6.4.
#pragma once

#include <memory>
#include <optional>

#include "incognita/control/controller.hpp"
#include "incognita/control/obstacle_avoidance.hpp"
#include "incognita/control/steering.hpp"
#include "incognita/models/mount.hpp"

namespace incognita {

/// The vehicle's planar position and heading, from its camera's state.
planar::Pose<double> axle_under(const CameraState& camera, const Mount& mount);

struct VehicleDriving {
  SteeringSettings steering;  ///< law of a TerrainVehicle, used if the goal has no `drive`
  Mount mount;
  std::optional<ObstacleAvoidanceSettings> obstacle_avoidance = {};
};

class VehicleController final : public Controller {
 public:
  /// `period_s`: duration of one command. Throws std::invalid_argument as make_steering and
  /// ObstacleAvoidanceSettings do.
  VehicleController(const VehicleDriving& driving, double period_s);

  /// Zero speeds before the start and when lost. A goal's `drive` takes precedence over the law.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
              const Tick& tick) override;

 private:
  Eigen::Vector2d desired_drive(const Estimate& estimate, const Goal& goal, const Tick& tick);

  VehicleDriving driving_;
  std::unique_ptr<Steering> law_;
  std::optional<double> first_t_;
  TurnSide turn_side_ = TurnSide::none;
};

}  // namespace incognita
