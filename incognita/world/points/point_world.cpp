#include "incognita/world/points/point_world.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

namespace incognita {
namespace {

void need(bool ok, const std::string& what) {
  if (!ok) throw std::invalid_argument(what);
}

void check(const AnyMotion& motion, const SimulatedPointSensor& s, const PointLandmarks& landmarks) {
  const std::string problem = incompatibility(motion, s.model);
  need(problem.empty(), problem);
  const int numbers = chart_of(s.model).tangent();
  need(s.sigmas.size() == numbers, "a sensor needs " + std::to_string(numbers) + " sigmas");
  need(s.sigmas.allFinite() && (s.sigmas.array() >= 0).all() && s.sigma_range_ratio >= 0 &&
           std::isfinite(s.sigma_range_ratio),
       "the sigmas of a sensor must be zero or positive");
  need(s.ticks_per_measurement >= 1, "ticks_per_measurement of a sensor must be at least 1");
  need(s.limits.max_range_m > 0 && s.limits.field_of_view_rad > 0,
       "range and field of view of a sensor must be positive");
  for (const auto& [identity, point] : landmarks) {
    const std::string which = "landmark " + std::to_string(identity);
    need(point.size() == dimensions_of(s.model), which + " has " + std::to_string(point.size()) +
                                                     " numbers, but the sensor measures in " +
                                                     std::to_string(dimensions_of(s.model)) + " dimensions");
    need(point.allFinite(), which + " must have finite coordinates");
  }
}

}  // namespace

PointDetector::PointDetector(AnyMotion motion, SimulatedPointSensor sensor, PointTargets targets,
                             std::uint64_t seed, const std::string& name,
                             std::shared_ptr<AssociationTruth> associations, int index)
    : motion_(std::move(motion)),
      sensor_(std::move(sensor)),
      targets_(std::move(targets)),
      noise_(seed, name),
      associations_(std::move(associations)),
      index_(index) {
  check(motion_, sensor_, targets_.landmarks);
}

std::optional<SmallVector> PointDetector::measured(const SmallVector& state, const SmallVector& point) {
  const SmallVector from = position_of(motion_, state, dimensions_of(sensor_.model)).position;
  const double distance_m = (from - point).norm();
  if (!(distance_m <= sensor_.limits.max_range_m)) return std::nullopt;
  const auto prediction = predict_measurement(sensor_.model, motion_, state, {}, point);
  if (!prediction || !is_in_view(sensor_.model, sensor_.limits, *prediction, distance_m)) return std::nullopt;
  SmallVector z = prediction->z, error(sensor_.sigmas.size());
  for (Eigen::Index k = 0; k < error.size(); ++k)
    error[k] =
        (sensor_.sigmas[k] + (k == 0 ? sensor_.sigma_range_ratio * std::abs(z[0]) : 0)) * noise_.normal();
  chart_of(sensor_.model)
      .plus({z.data(), static_cast<std::size_t>(z.size())},
            {error.data(), static_cast<std::size_t>(error.size())});
  if (!is_possible(sensor_.model, z)) return std::nullopt;
  return z;
}

void PointDetector::measure(const std::optional<Truth>& truth, std::size_t which, const Tick&,
                            BodyObservation& observation) {
  const SmallVector& state = truth_of(truth, which).state;
  std::vector<std::int64_t> identities;
  if (ticks_++ % sensor_.ticks_per_measurement == 0) {
    std::vector<PointDetection> own;
    for (const auto& [identity, point] : targets_.landmarks)
      if (auto z = measured(state, point)) own.push_back({identity, *z, index_});
    identities = remove_identities(own);
    observation.landmarks.insert(observation.landmarks.end(), own.begin(), own.end());
    for (std::size_t j = 0; targets_.vehicles && j < truth->bodies.size(); ++j) {
      if (j == which) continue;
      const SmallVector other = truth->bodies[j].pose->position.head(dimensions_of(sensor_.model));
      if (auto z = measured(state, other))
        observation.vehicles.push_back({static_cast<std::int64_t>(j), *z, index_});
    }
  }
  if (!associations_) return;
  std::vector<std::int64_t>& of_body = associations_->at(which);
  if (index_ == 0) of_body.clear();
  of_body.insert(of_body.end(), identities.begin(), identities.end());
}

/// Sorts the detections without identity by their values, so that their order does not reveal it. Returns all true
/// identities in the new order.
std::vector<std::int64_t> PointDetector::remove_identities(std::vector<PointDetection>& detections) const {
  const auto is_identified = [&](const PointDetection& d) {
    return !targets_.identified || targets_.identified->contains(d.identity);
  };
  const auto without_identity = std::stable_partition(detections.begin(), detections.end(), is_identified);
  std::stable_sort(without_identity, detections.end(), [](const PointDetection& a, const PointDetection& b) {
    return std::lexicographical_compare(a.z.begin(), a.z.end(), b.z.begin(), b.z.end());
  });
  std::vector<std::int64_t> identities;
  for (const PointDetection& d : detections) identities.push_back(d.identity);
  for (auto d = without_identity; d != detections.end(); ++d) d->identity = Detection::unknown;
  return identities;
}

SimulatedWorld point_world(const std::vector<SimulatedVehicle>& vehicles, std::uint64_t seed) {
  std::vector<SimulatedBody> bodies;
  for (const SimulatedVehicle& vehicle : vehicles) {
    const std::string stream = vehicle.body.mount ? "carrier." : "team.plant.";
    const std::string name = stream + std::to_string(bodies.size());
    bodies.push_back(vehicle.body);
    bodies.back().name = name;
  }
  return {std::move(bodies), seed};
}

SensorSet point_sensors(const std::vector<SimulatedVehicle>& vehicles, const PointTargets& targets,
                        std::uint64_t seed, const std::shared_ptr<AssociationTruth>& associations) {
  if (associations) associations->assign(vehicles.size(), {});
  std::vector<BodySensors> bodies;
  for (const SimulatedVehicle& vehicle : vehicles) {
    const AnyMotion motion = vehicle.body.mount ? AnyMotion(FreeCameraMotion{}) : vehicle.body.motion;
    auto detector = std::make_unique<PointDetector>(
        motion, vehicle.sensor, targets, seed, "team.sensor." + std::to_string(bodies.size()), associations);
    bodies.push_back(sensors_of_body(std::make_unique<InputSensor>(), std::move(detector)));
    if (vehicle.body.mount) bodies.back().push_back(std::make_unique<WheelEncoders>());
  }
  return SensorSet(std::move(bodies));
}

}  // namespace incognita
