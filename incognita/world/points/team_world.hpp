// Simulated point-landmark world with moving vehicles, and sensors that identify what they detect: the
// simulated environment of thesis Appendix B.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "incognita/models/any_sensor.hpp"
#include "incognita/world/operator_model.hpp"
#include "incognita/world/plant.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// Landmark positions by identity, each with the dimension of the world.
using PointLandmarks = std::map<std::int64_t, SmallVector>;

struct SimulatedVehicle {
  AnyMotion motion;
  PlantSettings plant;
  AnySensor sensor;
  SmallVector sigmas;             ///< true noise per measured number
  double sigma_range_ratio = 0;   ///< added to the first sigma, per unit of its value
  SensorLimits reach = {};        ///< limits beyond which points are not measured
  int ticks_per_measurement = 1;  ///< measurement interval; the first tick is one
};

class TeamWorld final : public World {
 public:
  /// `actuators`: operators who move the vehicles, which must be free cameras; none, or one per vehicle.
  /// Throws std::invalid_argument if the sizes differ.
  TeamWorld(const std::vector<SimulatedVehicle>& vehicles, std::uint64_t seed,
            std::vector<OperatorActuator> actuators = {});

  /// Vehicles without an input get zeros: they stand still, and bodies in space keep their velocity.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SmallVector executed_input(const Command& command, std::size_t body);

  std::vector<Plant> plants_;
  std::vector<OperatorActuator> actuators_;
  std::optional<double> last_t_;  ///< previous tick, when the command was given
};

/// True identities of the detections of the last tick, for evaluation: per vehicle, in the order of its observation.
using AssociationTruth = std::vector<std::vector<std::int64_t>>;

class TeamSensor final : public Sensor {
 public:
  /// `sees_vehicles`: whether vehicles detect their teammates. `named`: landmarks reported with their
  /// identity; empty: all. The others are reported without identity, ordered by their measured values. Throws
  /// std::invalid_argument if a sensor does not fit its vehicle or the landmarks.
  TeamSensor(std::vector<SimulatedVehicle> vehicles, PointLandmarks place, bool sees_vehicles,
             std::uint64_t seed, std::optional<std::set<std::int64_t>> named = std::nullopt);

  /// Updated by each measurement; not available to estimators.
  std::shared_ptr<const AssociationTruth> truth() const { return truth_; }

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  void measure_vehicle(std::size_t vehicle, const Truth& truth, BodyObservation& view);
  void remove_identities(BodyObservation& view, std::vector<std::int64_t>& truth) const;
  std::optional<SmallVector> measured(std::size_t vehicle, const SmallVector& state,
                                      const SmallVector& point);

  std::vector<SimulatedVehicle> vehicles_;
  PointLandmarks landmarks_;
  bool sees_vehicles_;
  std::int64_t ticks_ = 0;  ///< so far
  std::vector<RandomStream> noise_;
  std::optional<std::set<std::int64_t>> named_;
  std::shared_ptr<AssociationTruth> truth_ = std::make_shared<AssociationTruth>();
};

}  // namespace incognita
