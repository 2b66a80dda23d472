// The sensors of all bodies, simulated or recorded: each body may carry any set.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "incognita/world/world.hpp"

namespace incognita {

/// One sensor of one body.
class BodySensor : public SavedPart {
 public:
  /// Adds what it measures at a tick to the observation of body `which`, counted from 0. A simulated sensor throws
  /// std::invalid_argument without the truth that it needs.
  virtual void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
                       BodyObservation& observation) = 0;
};

using BodySensors = std::vector<std::unique_ptr<BodySensor>>;

template <class... Sensors>
BodySensors sensors_of_body(std::unique_ptr<Sensors>... sensors) {
  BodySensors out;
  (out.push_back(std::move(sensors)), ...);
  return out;
}

class SensorSet final : public Sensor {
 public:
  /// `bodies`: the sensors of each body.
  explicit SensorSet(std::vector<BodySensors> bodies) : bodies_(std::move(bodies)) {}
  /// Of one body.
  explicit SensorSet(BodySensors sensors) { bodies_.push_back(std::move(sensors)); }

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;
  void state(StateArchive& archive) override;

 private:
  std::vector<BodySensors> bodies_;
};

/// The true state of body `which`; throws std::invalid_argument if there is none.
const BodyTruth& truth_of(const std::optional<Truth>& truth, std::size_t which);

/// The input that a body executed, without its disturbance: exact odometry of its own model.
class InputSensor final : public BodySensor {
 public:
  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive&) override {}  // it has none
};

/// Wheel encoders of the vehicle that carries a camera: speed and turn rate, as odometry.
class WheelEncoders final : public BodySensor {
 public:
  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive&) override {}  // it has none
};

}  // namespace incognita
