// A sensor in the hand of a person, who feels how it moves.
#pragma once

#include <memory>
#include <utility>

#include "incognita/world/world.hpp"

namespace incognita {

/// Beside what the sensor sees, Observation::felt: the true states of the cameras that are held, the vehicles
/// of a team or the one camera.
class HeldSensor final : public Sensor {
 public:
  explicit HeldSensor(std::unique_ptr<Sensor> sensor) : sensor_(std::move(sensor)) {}

  Observation look(const std::optional<Truth>& truth, const Tick& tick) override {
    Observation seen = sensor_->look(truth, tick);
    if (!truth) return seen;
    seen.felt = truth->vehicles;
    if (seen.felt.empty()) seen.felt.emplace_back(truth->camera);
    return seen;
  }

 private:
  std::unique_ptr<Sensor> sensor_;
};

}  // namespace incognita
