#include "incognita/world/simulated_world.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace incognita {
namespace {

void check(const SimulatedBody& body) {
  if (body.mount && !std::holds_alternative<TerrainVehicle>(body.motion))
    throw std::invalid_argument("only a vehicle on uneven ground can carry a camera on a mount");
  if (body.actuator && (body.mount || !traits_of(body.motion).in_space()))
    throw std::invalid_argument("an operator can hold only a free camera");
}

}  // namespace

FreeCameraMotion::State<double> carried_camera(const TerrainVehicle& vehicle, const Mount& mount,
                                               const TerrainVehicle::State<double>& state,
                                               const TerrainVehicle::State<double>& state_rate) {
  const MountedCamera<3> mounted = mount.on(vehicle.pose(state));
  FreeCameraMotion::State<double> camera = mounted.camera;
  camera.tail<6>() = mounted.J * state_rate;  // velocity (world), and angular rate (camera axes)
  return camera;
}

SimulatedWorld::SimulatedWorld(std::vector<SimulatedBody> bodies, std::uint64_t seed) {
  if (bodies.empty()) throw std::invalid_argument("a simulated world needs a body");
  for (SimulatedBody& body : bodies) {
    check(body);
    Plant plant(body.motion, body.plant, seed, body.name);
    if (body.obstacles) body.obstacles->check_start(plant.state());
    bodies_.push_back({std::move(body), std::move(plant)});
  }
}

SimulatedWorld::SimulatedWorld(SimulatedBody body, std::uint64_t seed)
    : SimulatedWorld(std::vector{std::move(body)}, seed) {}

SmallVector SimulatedWorld::commanded(Simulated& simulated, const BodyCommand& command) {
  if (simulated.body.actuator && last_t_)
    return simulated.body.actuator->move(command, FreeCameraMotion::State<double>(simulated.plant.state()),
                                         *last_t_);
  return input_of(command, inputs_of(simulated.plant.motion()));
}

BodyTruth SimulatedWorld::truth_of(const Simulated& simulated) {
  const Plant& plant = simulated.plant;
  BodyTruth truth;
  if (simulated.body.mount) {
    const auto& vehicle = std::get<TerrainVehicle>(plant.motion());
    SmallVector input = plant.in_force();
    if (simulated.stopped) input[0] = 0;  // its wheels slip
    truth.state = carried_camera(vehicle, *simulated.body.mount, plant.state().head<3>(),
                                 rate_of(plant.motion(), plant.state(), input).head<3>());
    truth.pose = pose_of(FreeCameraMotion{}, truth.state);
    truth.input = SmallVector::Zero(FreeCameraMotion::input_size);
    truth.carrier = plant.state();
    truth.wheels = plant.executed();
    return truth;
  }
  truth.state = plant.state();
  truth.pose = pose_of(plant.motion(), truth.state);
  truth.input = plant.executed();
  if (simulated.body.actuator) truth.input.setZero();
  return truth;
}

SimulatedWorld::Simulated& SimulatedWorld::simulated(std::size_t body) {
  if (body < bodies_.size()) return bodies_[body];
  throw std::invalid_argument("body " + std::to_string(body + 1) + " does not exist; there are " +
                              std::to_string(bodies_.size()));
}

void SimulatedWorld::displace(const DisplaceBody& displacement) {
  Simulated& which = simulated(displacement.body);
  const SmallVector before = which.plant.state();
  SmallVector after = displaced(which.plant.motion(), before, displacement.by_m, displacement.turn_rad);
  if (which.body.obstacles) which.body.obstacles->stop(before, after);
  which.plant.put(after);
}

void SimulatedWorld::push(const PushBody& push) {
  Simulated& which = simulated(push.body);
  which.push_m_s = push.velocity_m_s;
  which.push_left_s = push.duration_s;
}

void SimulatedWorld::push_on(Simulated& simulated, double dt_s) {
  const double pushed_s = std::min(dt_s, simulated.push_left_s);
  if (pushed_s <= 0) return;
  simulated.push_left_s -= pushed_s;
  simulated.plant.put(
      displaced(simulated.plant.motion(), simulated.plant.state(), pushed_s * simulated.push_m_s, 0));
}

std::optional<Truth> SimulatedWorld::move(const Command& command, const Tick& tick) {
  Truth truth;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Simulated& simulated = bodies_[i];
    const SmallVector before = simulated.plant.state();
    simulated.plant.move(commanded(simulated, command_of(command, i)), tick.dt);
    push_on(simulated, tick.dt);
    SmallVector after = simulated.plant.state();
    if (simulated.body.obstacles && tick.dt > 0) {
      simulated.stopped = simulated.body.obstacles->stop(before, after);
      if (simulated.stopped) simulated.plant.put(after);
    }
    truth.bodies.push_back(truth_of(simulated));
  }
  last_t_ = tick.t;
  return truth;
}

}  // namespace incognita
