// What a place and a sensor are to the loop. Simulation, a recording and a real robot differ in these alone.
#pragma once

#include <optional>

#include "incognita/messages/command.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

/// Where time comes from: the frame rate of a simulation, the stamps of a recording, a real clock.
class Clock {
 public:
  virtual ~Clock() = default;
  /// The next turn, or an empty Tick at the end.
  virtual Tick next() = 0;
  /// How many turns there will be, 0 when unknown. For progress only.
  virtual std::int64_t expected_frames() const = 0;
};

/// The place and the body in it.
class World {
 public:
  virtual ~World() = default;
  /// Carries the command, held since the tick before, through `tick.dt` seconds. Nothing where the truth is
  /// unknown.
  virtual std::optional<Truth> move(const Command& command, const Tick& tick) = 0;
};

/// What the body sees of it.
class Sensor {
 public:
  virtual ~Sensor() = default;
  /// Throws std::runtime_error naming file and remedy when the sensor fails for good.
  virtual Observation measure(const std::optional<Truth>& truth, const Tick& tick) = 0;
};

}  // namespace incognita
