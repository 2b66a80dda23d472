// A recording as clock, sensor and, if the truth is known, world of the loop.
#pragma once

#include <memory>

#include "incognita/io/recordings/recording.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

using SharedRecording = std::shared_ptr<const Recording>;

/// Ticks at the time stamps of the recording, until it ends or `duration_s` after its first.
class RecordedClock : public Clock {
 public:
  RecordedClock(SharedRecording recording, double duration_s);
  Tick next() override;
  std::int64_t expected_frames() const override { return frames_; }

 private:
  SharedRecording recording_;
  std::int64_t frames_ = 0;
  std::int64_t done_ = 0;
};

/// Returns image k at tick k.
class RecordedSensor : public Sensor {
 public:
  /// Reads the first image: throws InputError naming it, and both sizes if it does not have the camera's size.
  RecordedSensor(SharedRecording recording, int width_px, int height_px);

  /// Throws RecordError naming file and frame if an image is missing, damaged or of another size.
  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  std::shared_ptr<const Image> read(std::int64_t frame) const;

  SharedRecording recording_;
  int width_px_, height_px_;
  std::shared_ptr<const Image> first_;
};

/// Returns the recorded pose nearest in time within 20 ms, the association rule of the TUM benchmark tools.
/// Velocities are finite differences of the neighboring poses. Commands are ignored.
class RecordedWorld : public World {
 public:
  explicit RecordedWorld(SharedRecording recording) : recording_(std::move(recording)) {}
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SharedRecording recording_;
};

}  // namespace incognita
