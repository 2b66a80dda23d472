// A simulated place of points, vehicles that move in it, and sensors that name what they see: the simulated
// environment of thesis Appendix B.
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

/// Landmarks by identity; each as many numbers as the place has dimensions.
using PointLandmarks = std::map<std::int64_t, SmallVector>;

struct SimulatedVehicle {
  AnyMotion motion;
  PlantSettings plant;
  AnySensor sensor;
  SmallVector sigmas;             ///< true noise of each number that is measured
  double sigma_range_ratio = 0;   ///< added to the first of them, times what is measured
  SensorLimits reach = {};        ///< beyond, points are not measured
  int ticks_per_measurement = 1;  ///< it looks at every so many-th tick, the first being one
};

class TeamWorld final : public World {
 public:
  /// `actuators`: of operators who move the vehicles, free cameras all; none, or one for each. Throws
  /// std::invalid_argument where sizes do not fit.
  TeamWorld(const std::vector<SimulatedVehicle>& vehicles, std::uint64_t seed,
            std::vector<OperatorActuator> actuators = {});

  /// Vehicles without an input have one of 0: they stand still, bodies in space go on as they go.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SmallVector input_of(const Command& command, std::size_t vehicle);

  std::vector<Plant> plants_;
  std::vector<OperatorActuator> actuators_;
  std::optional<double> last_t_;  ///< of the tick before: when the command was given
};

/// Which landmark each sighting was of at the last tick, for who scores: per vehicle, in its view's order.
using AssociationTruth = std::vector<std::vector<std::int64_t>>;

class TeamSensor final : public Sensor {
 public:
  /// `sees_vehicles`: whether vehicles see the others of their team, too. `named`: the landmarks that it can
  /// name; without it, all. The others come without a name, in the order of what is measured. Throws
  /// std::invalid_argument where a sensor does not fit its vehicle, or the place.
  TeamSensor(std::vector<SimulatedVehicle> vehicles, PointLandmarks place, bool sees_vehicles,
             std::uint64_t seed, std::optional<std::set<std::int64_t>> named = std::nullopt);

  /// Changes with each look. No part of what an estimator is given.
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
