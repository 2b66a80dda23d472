#include "experiments/closed_loop_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "experiments/chapter_5_vehicle.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/math/random.hpp"
#include "incognita/world/fixed_rate_clock.hpp"

namespace incognita::closed_loop {
namespace {

using Eigen::Vector2d;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int ticks_per_joint_nees = 10;

/// Points of the desired paths of all examples.
std::vector<Vector2d> desired_points() {
  constexpr int points = 120;
  std::vector<Vector2d> all;
  for (int k = 0; k <= points; ++k) {
    const double share = static_cast<double>(k) / points, angle = 2 * std::numbers::pi * share;
    const Vector2d out(std::cos(angle), std::sin(angle));
    all.push_back(Vector2d(-7, 0) + share * Vector2d(17, 10));
    all.push_back(7 * out);
    all.push_back(Vector2d(-6, 0) + 5 * out);
    all.push_back(Vector2d(6, 0) + 5 * out);
  }
  return all;
}

bool clear_of(const std::vector<Vector2d>& others, const Vector2d& point, double distance) {
  return std::ranges::all_of(others,
                             [&](const Vector2d& other) { return (point - other).norm() > distance; });
}

/// The simulated vehicles, the filter and the control laws.
struct Scene {
  std::vector<SimulatedVehicle> vehicles;
  EstimatorSettings filter;
  std::vector<BodyControl> control;
};

BodyModel member_of(const Setup& s, const Robot& robot) {
  BodyModel m = body_with_sensor(body, RangeBearingSensor{}, robot.start, start_sigmas, input_sigmas,
                                 measurement_sigmas);
  m.start_sigmas *= s.noise, m.input_sigmas *= s.noise, m.sensors[0].sigmas *= s.noise;
  return m;
}

Scene scene_of(const Setup& s) {
  Scene scene;
  scene.filter.filter.linearization = s.linearization;
  for (const Robot& robot : s.robots) {
    const BodyModel m = member_of(s, robot);
    const SmallVector most = robot.steering.most_input;
    SimulatedVehicle vehicle{{m.motion, {m.start, m.start_sigmas, m.input_sigmas, -most, most}, {}},
                             {m.sensors[0].sensor, m.sensors[0].sigmas}};
    vehicle.sensor.limits.field_of_view_rad = std::numbers::pi;
    scene.vehicles.push_back(vehicle);
    scene.filter.bodies.push_back(m);
    scene.control.push_back({m.motion, robot.steering});
  }
  for (const auto& [identity, point] : s.place)
    if (identity < s.anchors) scene.filter.anchors[identity] = point;
  return scene;
}

/// Between scans there is odometry alone.
Observation odometry_alone(const Truth& truth) {
  Observation observation;
  for (const BodyTruth& body : truth.bodies) observation.bodies.emplace_back().input = body.input;
  return observation;
}

Instant instant_of(const Tick& tick, const Truth& truth, const Estimate& e, const Command& command,
                   std::size_t landmarks) {
  Instant now{tick.t, {}, std::vector<double>(landmarks, unknown)};
  for (std::size_t i = 0; i < e.bodies.size(); ++i) {
    const BlockId block = e.bodies[i].block;
    now.robots.push_back({truth.bodies[i].state, e.belief.mean(block), e.belief.covariance(block),
                          command.bodies.at(i).input});
  }
  for (const auto& [identity, landmark] : e.landmarks)
    now.traces.at(static_cast<std::size_t>(identity)) = e.belief.covariance(landmark.block).trace();
  return now;
}

/// Where the robots would be without noise.
class Plan {
 public:
  explicit Plan(const std::vector<Robot>& robots) {
    for (const Robot& robot : robots) poses_.push_back(robot.start);
  }
  const Pose& pose(std::size_t robot) const { return poses_[robot]; }
  void move(const Command& command) {
    for (std::size_t i = 0; i < poses_.size(); ++i)
      poses_[i] = moved(poses_[i], Vector2d(command.bodies.at(i).input));
  }

 private:
  std::vector<Pose> poses_;
};

/// What the laws are given in place of the estimate.
Estimate given_instead(SteeredBy by, const Estimate& e, const Truth& truth, const Plan& plan) {
  Estimate given;
  given.started = e.started;
  given.status = e.status;
  given.bodies = e.bodies;
  for (std::size_t i = 0; i < given.bodies.size(); ++i)
    given.bodies[i].state = by == SteeredBy::truth ? truth.bodies[i].state : SmallVector(plan.pose(i));
  return given;
}

double joint_nees(const Instant& now, const Estimate& e, const PointLandmarks& place) {
  Eigen::VectorXd error(e.belief.errors());
  for (std::size_t i = 0; i < e.bodies.size(); ++i)
    error.segment<3>(e.belief.offset(e.bodies[i].block)) = now.robots[i].error();
  for (const auto& [identity, landmark] : e.landmarks)
    error.segment<2>(e.belief.offset(landmark.block)) =
        place.at(identity) - SmallVector(e.belief.mean(landmark.block));
  return error.dot(e.belief.dense_covariance().llt().solve(error)) / static_cast<double>(error.size());
}

}  // namespace

PointLandmarks sixteen_landmarks() {
  RandomStream random(1, "place");
  const std::vector<Vector2d> taken = desired_points();
  std::vector<Vector2d> points;
  while (points.size() < 16) {
    const double x = random.uniform(-12, 12), y = random.uniform(-12, 12);
    if (clear_of(taken, {x, y}, 1) && clear_of(points, {x, y}, 2.5)) points.emplace_back(x, y);
  }
  PointLandmarks place;
  for (const Vector2d& point : points) place[static_cast<std::int64_t>(place.size())] = point;
  return place;
}

Robot robot(const planar::Pose<double>& start, ControlLaw law, const Path& path) {
  Robot r{start, {}};
  r.steering.law = law;
  r.steering.path = path;
  r.steering.most_input = Vector2d(top_speed_m_s, top_turn_rate);
  return r;
}

Run drive(const Setup& setup, std::uint64_t seed) {
  Scene scene = scene_of(setup);
  SimulatedWorld world = point_world(scene.vehicles, seed);
  SensorSet sensors = point_sensors(scene.vehicles, {setup.place}, seed);
  SlamEstimator estimator(scene.filter);
  SteeringController controller(std::move(scene.control), period_s);
  FixedRateClock clock(1 / period_s, setup.duration_s);
  Estimate estimate;
  Command command;
  Plan plan(setup.robots);
  Run run;
  while (const Tick tick = clock.next()) {
    const auto truth = world.move(command, tick);
    const bool scans = tick.frame % ticks_per_scan == 0;
    estimator.update(estimate, command, scans ? sensors.measure(truth, tick) : odometry_alone(*truth), tick);
    command = setup.steered_by == SteeredBy::estimate
                  ? controller.act(estimate, {}, {}, tick)
                  : controller.act(given_instead(setup.steered_by, estimate, *truth, plan), {}, {}, tick);
    plan.move(command);
    run.instants.push_back(instant_of(tick, *truth, estimate, command, setup.place.size()));
    if (tick.frame % ticks_per_joint_nees == 0)
      run.joint_nees.push_back(joint_nees(run.instants.back(), estimate, setup.place));
  }
  for (const auto& [id, landmark] : estimate.landmarks)
    if (!landmark.fixed)
      run.map.push_back({setup.place.at(id), estimate.belief.mean(landmark.block),
                         estimate.belief.covariance(landmark.block)});
  return run;
}

}  // namespace incognita::closed_loop
