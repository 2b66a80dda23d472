#include "incognita/world/points/team_world.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

namespace incognita {
namespace {

std::string stream_of(const char* what, std::size_t vehicle) {
  return std::string("team.") + what + "." + std::to_string(vehicle);
}

void need(bool ok, const std::string& what) {
  if (!ok) throw std::invalid_argument(what);
}

void check(const SimulatedVehicle& v, const PointLandmarks& place) {
  const std::string problem = incompatibility(v.motion, v.sensor);
  need(problem.empty(), problem);
  const int numbers = chart_of(v.sensor).tangent();
  need(v.sigmas.size() == numbers, "a sensor needs " + std::to_string(numbers) + " sigmas");
  need(v.sigmas.allFinite() && (v.sigmas.array() >= 0).all() && v.sigma_range_ratio >= 0 &&
           std::isfinite(v.sigma_range_ratio),
       "the sigmas of a sensor must be zero or positive");
  need(v.ticks_per_measurement >= 1, "ticks_per_measurement of a sensor must be at least 1");
  need(v.reach.max_range_m > 0 && v.reach.field_of_view_rad > 0,
       "range and field of view of a sensor must be positive");
  for (const auto& [identity, point] : place) {
    const std::string which = "landmark " + std::to_string(identity);
    need(point.size() == dimensions_of(v.sensor),
         which + " has " + std::to_string(point.size()) + " numbers, but the sensor measures in " +
             std::to_string(dimensions_of(v.sensor)) + " dimensions");
    need(point.allFinite(), which + " must have finite coordinates");
  }
}

}  // namespace

TeamWorld::TeamWorld(const std::vector<SimulatedVehicle>& vehicles, std::uint64_t seed,
                     std::vector<OperatorActuator> actuators)
    : actuators_(std::move(actuators)) {
  if (vehicles.empty()) throw std::invalid_argument("a team needs a vehicle");
  need(
      actuators_.empty() || actuators_.size() == vehicles.size(),
      std::to_string(vehicles.size()) + " vehicles, but " + std::to_string(actuators_.size()) + " operators");
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    need(actuators_.empty() || traits_of(vehicles[i].motion).in_space(),
         "an operator can hold only a free camera");
    plants_.emplace_back(vehicles[i].motion, vehicles[i].plant, seed, stream_of("plant", i));
  }
}

SmallVector TeamWorld::executed_input(const Command& command, std::size_t i) {
  const Plant& plant = plants_[i];
  if (!actuators_.empty() && last_t_)
    return actuators_[i].move(command_of(command, i), FreeCameraMotion::State<double>(plant.state()),
                              *last_t_);
  return input_of(command, i, inputs_of(plant.motion()));
}

std::optional<Truth> TeamWorld::move(const Command& command, const Tick& tick) {
  Truth truth;
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    BodyTruth& body = truth.bodies.emplace_back();
    body.state = plants_[i].move(executed_input(command, i), tick.dt);
    body.pose = pose_of(plants_[i].motion(), body.state);
    const SmallVector& executed = plants_[i].executed();
    // The operator's inputs are not measured
    body.input = actuators_.empty() ? executed : SmallVector(SmallVector::Zero(executed.size()));
  }
  last_t_ = tick.t;
  return truth;
}

TeamSensor::TeamSensor(std::vector<SimulatedVehicle> vehicles, PointLandmarks place, bool sees_vehicles,
                       std::uint64_t seed, std::optional<std::set<std::int64_t>> named)
    : vehicles_(std::move(vehicles)),
      landmarks_(std::move(place)),
      sees_vehicles_(sees_vehicles),
      named_(std::move(named)) {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    check(vehicles_[i], landmarks_);
    noise_.emplace_back(seed, stream_of("sensor", i));
  }
}

std::optional<SmallVector> TeamSensor::measured(std::size_t i, const SmallVector& state,
                                                const SmallVector& point) {
  const SimulatedVehicle& v = vehicles_[i];
  const SmallVector from = position_of(v.motion, state, dimensions_of(v.sensor)).position;
  const double distance_m = (from - point).norm();
  if (!(distance_m <= v.reach.max_range_m)) return std::nullopt;
  const auto prediction = predict_measurement(v.sensor, v.motion, state, {}, point);
  if (!prediction || !is_in_view(v.sensor, v.reach, *prediction, distance_m)) return std::nullopt;
  SmallVector z = prediction->z, error(v.sigmas.size());
  for (Eigen::Index k = 0; k < error.size(); ++k)
    error[k] = (v.sigmas[k] + (k == 0 ? v.sigma_range_ratio * std::abs(z[0]) : 0)) * noise_[i].normal();
  chart_of(v.sensor).plus({z.data(), static_cast<std::size_t>(z.size())},
                          {error.data(), static_cast<std::size_t>(error.size())});
  if (!is_possible(v.sensor, z)) return std::nullopt;
  return z;
}

void TeamSensor::measure_vehicle(std::size_t i, const Truth& truth, BodyObservation& view) {
  for (const auto& [identity, point] : landmarks_)
    if (auto z = measured(i, truth.bodies[i].state, point)) view.landmarks.push_back({identity, *z});
  remove_identities(view, truth_->at(i));
  for (std::size_t j = 0; sees_vehicles_ && j < vehicles_.size(); ++j) {
    if (j == i) continue;
    const SmallVector other =
        position_of(vehicles_[j].motion, truth.bodies[j].state, dimensions_of(vehicles_[i].sensor)).position;
    if (auto z = measured(i, truth.bodies[i].state, other))
      view.vehicles.push_back({static_cast<std::int64_t>(j), *z});
  }
}

/// Sorts the detections without identity by their values, so that their order does not reveal it.
void TeamSensor::remove_identities(BodyObservation& view, std::vector<std::int64_t>& truth) const {
  const auto is_named = [&](const PointDetection& s) { return !named_ || named_->count(s.identity) > 0; };
  const auto without_identity = std::stable_partition(view.landmarks.begin(), view.landmarks.end(), is_named);
  std::stable_sort(without_identity, view.landmarks.end(),
                   [](const PointDetection& a, const PointDetection& b) {
                     return std::lexicographical_compare(a.z.begin(), a.z.end(), b.z.begin(), b.z.end());
                   });
  for (const PointDetection& s : view.landmarks) truth.push_back(s.identity);
  for (auto s = without_identity; s != view.landmarks.end(); ++s) s->identity = Detection::unknown;
}

Observation TeamSensor::measure(const std::optional<Truth>& truth, const Tick& tick) {
  Observation observation;
  if (!truth || truth->bodies.size() != vehicles_.size())
    throw std::logic_error("TeamSensor: the truth has another number of vehicles");
  truth_->assign(vehicles_.size(), {});
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    BodyObservation view;
    if (tick.dt > 0) view.input = truth->bodies[i].input;
    view.wheels = truth->bodies[i].wheels;
    if (ticks_ % vehicles_[i].ticks_per_measurement == 0) measure_vehicle(i, *truth, view);
    observation.bodies.push_back(std::move(view));
  }
  ++ticks_;
  return observation;
}

}  // namespace incognita
