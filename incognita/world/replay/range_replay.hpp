// A recording of ranges and bearings as the loop sees it: its clock, its sensors and, where known, the truth.
#pragma once

#include <memory>

#include "incognita/world/replay/range_recording.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

using SharedRangeRecording = std::shared_ptr<const RangeRecording>;

/// A tick per scan, until `duration_s` have passed since the first event of any kind.
class RangeClock final : public Clock {
 public:
  RangeClock(SharedRangeRecording recording, double duration_s);
  Tick next() override;
  std::int64_t expected_frames() const override { return ticks_; }

 private:
  SharedRangeRecording recording_;
  std::int64_t ticks_ = 0;
  std::int64_t done_ = 0;
};

/// The true place between the two known next to the tick's time, if they are at most half a second apart.
/// Commands move nothing: what was recorded has happened.
class RangeWorld final : public World {
 public:
  explicit RangeWorld(SharedRangeRecording recording) : recording_(std::move(recording)) {}
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SharedRangeRecording recording_;
};

/// Which of the recording's position fixes the vehicle is told of.
enum class Fixes { none, first, all };

/// Scan k at tick k, with what the wheels and the external sensor told since tick k - 1.
class RangeSensor final : public Sensor {
 public:
  /// Detections beyond `max_range_m` are left out.
  RangeSensor(SharedRangeRecording recording, Fixes fixes, double max_range_m)
      : recording_(std::move(recording)), fixes_(fixes), max_range_m_(max_range_m) {}
  Observation look(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  SharedRangeRecording recording_;
  Fixes fixes_;
  double max_range_m_;
  std::size_t odometry_done_ = 0, fixes_done_ = 0;
  bool fix_given_ = false;
};

/// Time of the first event that the vehicle could know of, s: odometry, scan or fix.
double start_time(const RangeRecording& recording);

/// The true place at a time, interpolated; nothing where the truth has a hole.
std::optional<RangeRecording::Place> true_place(const RangeRecording& recording, double t);

}  // namespace incognita
