// The vehicle of the rendered room as a robot: it drives with the velocity that its watchdog lets pass, and avoids walls and boxes by
// itself, as the low-level behavior of thesis Section 6.4.3. Time is explicit.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "incognita/control/obstacle_avoidance.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/live/robot/watchdog.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// The true state of the robot after a step.
struct RobotState {
  double t = 0;  ///< s, since the robot started
  CommandWatchdog::Stop reason = CommandWatchdog::Stop::no_command;
  std::optional<double> command_t;  ///< when the last command that counted came
  Eigen::Vector2d executed{0, 0};   ///< speed, m/s, and turn rate, rad/s, during the step
  Eigen::Vector3d pose{0, 0, 0};    ///< of the axle: x, y, m, and heading, rad
  RigidPose camera = {};            ///< world_from_camera
  Eigen::Vector3d odometry{0, 0,
                           0};  ///< x, y, m, and heading, rad, from the wheels alone, from where it started
};

class SimulatedRobot {
 public:
  /// Throws InputError unless a vehicle carries the camera in the room of the scenario.
  SimulatedRobot(const LoadedScenario& loaded, const CommandWatchdog::Settings& watchdog);

  CommandWatchdog& watchdog() { return watchdog_; }
  const RobotState& state() const { return state_; }

  /// Moves until that time, in steps of 10 ms or less, one of which ends when the watchdog stops the robot. `after`, if given,
  /// receives the state after each step.
  void advance(double until_s, const std::function<void(const RobotState&)>& after = {});
  /// What its sensors measure now; image and ranges.
  BodyObservation measure();
  /// Puts the axle somewhere else: x, y, heading.
  void put(const Eigen::Vector3d& pose);

 private:
  void step(double dt_s);
  Eigen::Vector2d clear_of_obstacles(const Eigen::Vector2d& velocity);

  std::unique_ptr<World> world_;
  std::unique_ptr<Sensor> sensors_;
  std::optional<ObstacleAvoidanceSettings> avoidance_;
  CommandWatchdog watchdog_;
  double timeout_s_;
  std::optional<Truth> truth_;
  std::vector<ConeRange> ranges_;
  TurnSide turn_side_ = TurnSide::none;
  std::int64_t frame_ = 0;
  RobotState state_;
};

}  // namespace incognita
