// A recording as the loop sees it: its clock, its sensor and, where the truth is known, its world.
#pragma once

#include <memory>

#include "incognita/io/recordings/recording.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

using SharedRecording = std::shared_ptr<const Recording>;

/// The stamps of the recording, until it ends or `duration_s` have passed since its first.
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

/// Image k at tick k.
class RecordedSensor : public Sensor {
 public:
  /// Reads the first image: throws InputError naming it and both sizes unless it is one of the camera's.
  RecordedSensor(SharedRecording recording, int width_px, int height_px);

  /// Throws RecordError naming file and frame when an image is missing, broken or of another size.
  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  std::shared_ptr<const Image> read(std::int64_t frame) const;

  SharedRecording recording_;
  int width_px_, height_px_;
  std::shared_ptr<const Image> first_;
};

/// The recorded pose nearest in time, if within 20 ms, as the tools of the TUM benchmark associate.
/// Velocities are differences of the poses on either side. Commands move nothing: what was recorded has
/// happened.
class RecordedWorld : public World {
 public:
  explicit RecordedWorld(SharedRecording recording) : recording_(std::move(recording)) {}
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SharedRecording recording_;
};

}  // namespace incognita
