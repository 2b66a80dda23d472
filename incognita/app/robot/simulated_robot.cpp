#include "incognita/app/robot/simulated_robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr double longest_step_s = 0.01;

const LoadedScenario& with_vehicle(const LoadedScenario& loaded) {
  if (!loaded.scenario.is_room_vehicle())
    throw InputError(
        loaded.name +
        ": the simulated robot is a vehicle in the rendered room: world.type = \"room\" and vehicle.model = "
        "\"terrain\", as in explore-terrain");
  return loaded;
}

}  // namespace

SimulatedRobot::SimulatedRobot(const LoadedScenario& loaded, const CommandWatchdog::Settings& watchdog)
    : avoidance_(obstacle_avoidance_of(with_vehicle(loaded).scenario)),
      watchdog_(watchdog),
      timeout_s_(watchdog.timeout_s) {
  Assembly assembly = assemble(loaded);
  world_ = std::move(assembly.parts.world);
  sensors_ = std::move(assembly.parts.sensor);
  step(0);
}

void SimulatedRobot::advance(double until_s, const std::function<void(const RobotState&)>& after) {
  while (state_.t < until_s) {
    double dt_s = std::min(longest_step_s, until_s - state_.t);
    if (const auto command_t = watchdog_.last_command_s()) {
      const double left_s = *command_t + timeout_s_ - state_.t;
      if (left_s > 0) dt_s = std::min(dt_s, left_s);
    }
    step(dt_s);
    if (after) after(state_);
  }
}

void SimulatedRobot::step(double dt_s) {
  state_.reason = watchdog_.reason(state_.t);
  state_.command_t = watchdog_.last_command_s();
  const Eigen::Vector2d velocity = clear_of_obstacles(watchdog_.velocity(state_.t));
  Command command;
  command.bodies.emplace_back().input = velocity;
  state_.t += dt_s;
  truth_ = world_->move(command, {frame_++, state_.t, dt_s});
  const BodyTruth& body = truth_->bodies.front();
  state_.executed = *body.wheels;
  state_.pose = body.carrier.head<3>();
  state_.camera = *body.pose;
  Eigen::Vector3d& odometry = state_.odometry;
  const double heading = odometry[2] + state_.executed[1] * dt_s / 2;
  odometry += dt_s * Eigen::Vector3d(state_.executed[0] * std::cos(heading),
                                     state_.executed[0] * std::sin(heading), state_.executed[1]);
}

Eigen::Vector2d SimulatedRobot::clear_of_obstacles(const Eigen::Vector2d& velocity) {
  if (!avoidance_ || velocity.isZero()) return velocity;
  const AvoidanceCommand clear = avoid_obstacles(velocity, ranges_, *avoidance_, turn_side_);
  turn_side_ = clear.turn_side;
  return clear.drive;
}

BodyObservation SimulatedRobot::measure() {
  const Observation observation = sensors_->measure(truth_, {frame_, state_.t, longest_step_s});
  ranges_ = observation.bodies.front().proximity_ranges;
  return observation.bodies.front();
}

void SimulatedRobot::put(const Eigen::Vector3d& pose) {
  const Eigen::Vector3d by = pose - state_.pose;
  world_->displace({0, {by.x(), by.y(), 0}, by.z()});
  step(0);
}

}  // namespace incognita
