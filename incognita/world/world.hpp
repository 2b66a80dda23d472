// Interfaces between the loop and the world. Simulation, recordings and real robots differ only in these.
#pragma once

#include <optional>

#include "incognita/math/saved_state/saved_part.hpp"
#include "incognita/messages/command.hpp"
#include "incognita/messages/intervention.hpp"
#include "incognita/messages/observation.hpp"
#include "incognita/messages/tick.hpp"
#include "incognita/world/truth.hpp"

namespace incognita {

/// Source of time: frame rate of a simulation, time stamps of a recording, or a real clock.
class Clock : public SavedPart {
 public:
  /// Next tick, or an empty Tick at the end.
  virtual Tick next() = 0;
  /// Number of ticks, 0 if unknown; only used to report progress.
  virtual std::int64_t expected_frames() const = 0;
};

/// The environment and the bodies that move in it.
class World : public SavedPart {
 public:
  /// Executes the command, given at the previous tick, for `tick.dt` seconds. Returns the truth, empty if unknown.
  virtual std::optional<Truth> move(const Command& command, const Tick& tick) = 0;
  /// Disturbs a true body before its next move. Throws std::invalid_argument where that is impossible: in a recording,
  /// or for a body that does not exist.
  virtual void displace(const DisplaceBody& displacement);
  virtual void push(const PushBody& push);
};

/// The sensors of all bodies.
class Sensor : public SavedPart {
 public:
  /// Throws std::runtime_error on permanent failure; the message names the file and the remedy.
  virtual Observation measure(const std::optional<Truth>& truth, const Tick& tick) = 0;
};

}  // namespace incognita
