#include "incognita/world/sensor_set.hpp"

#include <stdexcept>
#include <string>

namespace incognita {

Observation SensorSet::measure(const std::optional<Truth>& truth, const Tick& tick) {
  Observation observation;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyObservation& body = observation.bodies.emplace_back();
    for (const std::unique_ptr<BodySensor>& sensor : bodies_[i]) sensor->measure(truth, i, tick, body);
  }
  return observation;
}

const BodyTruth& truth_of(const std::optional<Truth>& truth, std::size_t which) {
  if (!truth || which >= truth->bodies.size())
    throw std::invalid_argument("a simulated sensor needs the true state of body " +
                                std::to_string(which + 1));
  return truth->bodies[which];
}

void InputSensor::measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
                          BodyObservation& observation) {
  if (tick.dt > 0) observation.input = truth_of(truth, which).input;
}

void WheelEncoders::measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
                            BodyObservation& observation) {
  const BodyTruth& body = truth_of(truth, which);
  if (!body.wheels) throw std::invalid_argument("wheel encoders need a vehicle that carries the camera");
  if (tick.dt > 0) observation.odometry.push_back({tick.t, *body.wheels});
}

}  // namespace incognita
