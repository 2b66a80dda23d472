// The simulated environment of thesis Appendix B: vehicles among point landmarks, with sensors that measure landmarks
// and other vehicles.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "incognita/models/any_sensor.hpp"
#include "incognita/world/sensor_set.hpp"
#include "incognita/world/simulated_world.hpp"

namespace incognita {

/// Landmark positions by identity, each with the dimension of the world.
using PointLandmarks = std::map<std::int64_t, SmallVector>;

/// A sensor of point landmarks with its true noise.
struct SimulatedPointSensor {
  AnySensor model;
  SmallVector sigmas;             ///< true noise per measured number
  double sigma_range_ratio = 0;   ///< added to the first sigma, per unit of its value
  SensorLimits limits = {};       ///< beyond which points are not measured
  int ticks_per_measurement = 1;  ///< measurement interval; the first tick is one
};

/// A body with one point sensor. point_world() names its random streams.
struct SimulatedVehicle {
  SimulatedBody body;
  SimulatedPointSensor sensor;
};

/// What the point sensors of all vehicles detect.
struct PointTargets {
  PointLandmarks landmarks;
  bool vehicles = false;  ///< whether vehicles detect each other
  /// Landmarks reported with their identity; empty: all. The others are ordered by their measured values.
  std::optional<std::set<std::int64_t>> identified = {};
};

/// True identities of the landmark detections of the last tick, for evaluation: per vehicle, in the order of its
/// observation.
using AssociationTruth = std::vector<std::vector<std::int64_t>>;

class PointDetector final : public BodySensor {
 public:
  /// `motion`: of the body that carries it. `name`: of its random stream, one per sensor. `associations`: receives the
  /// true identities; may be null, otherwise it has one entry per body. `index`: among the point sensors of the body, in
  /// the order in which they measure. Throws std::invalid_argument if the sensor does not fit the body or the landmarks.
  PointDetector(AnyMotion motion, SimulatedPointSensor sensor, PointTargets targets, std::uint64_t seed,
                const std::string& name, std::shared_ptr<AssociationTruth> associations = nullptr,
                int index = 0);

  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive& archive) override;

 private:
  std::optional<SmallVector> measured(const SmallVector& state, const SmallVector& point);
  std::vector<std::int64_t> remove_identities(std::vector<PointDetection>& detections) const;

  AnyMotion motion_;
  SimulatedPointSensor sensor_;
  PointTargets targets_;
  std::int64_t ticks_ = 0;  ///< so far
  RandomStream noise_;
  std::shared_ptr<AssociationTruth> associations_;
  int index_;
};

SimulatedWorld point_world(const std::vector<SimulatedVehicle>& vehicles, std::uint64_t seed);

/// For each vehicle its point sensor and the input that it executed; wheel encoders where it carries a camera.
SensorSet point_sensors(const std::vector<SimulatedVehicle>& vehicles, const PointTargets& targets,
                        std::uint64_t seed, const std::shared_ptr<AssociationTruth>& associations = nullptr);

}  // namespace incognita
