// Recordings of vehicles that measure ranges and bearings, made on one clock, as the loop sees them: the clock, the
// sensors and, where known, the truth.
#pragma once

#include <memory>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// One per vehicle. Vehicle i of a recording's `vehicles` detections is the i-th.
using SharedRangeRecordings = std::shared_ptr<const std::vector<RangeRecording>>;

/// A tick for each time at which any of them scanned, until `duration_s` have passed since the start: of one
/// recording its first event of any kind, of several the time from which all have odometry.
class RangeClock final : public Clock {
 public:
  RangeClock(const SharedRangeRecordings& recordings, double duration_s);
  Tick next() override;
  std::int64_t expected_frames() const override { return static_cast<std::int64_t>(times_.size()); }

 private:
  std::vector<double> times_;
  std::size_t done_ = 0;
};

/// The true pose of each vehicle, where it is known: interpolated between two poses at most half a second apart.
/// Commands move nothing: what was recorded has happened.
class RangeWorld final : public World {
 public:
  explicit RangeWorld(SharedRangeRecordings recordings) : recordings_(std::move(recordings)) {}
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SharedRangeRecordings recordings_;
};

/// Which position fixes of a recording the vehicle measures.
enum class Fixes { none, first, all };

struct RangeSensorSettings {
  double max_range_m = 1e9;  ///< detections beyond are left out
  Fixes fixes = Fixes::none;
  bool measures_vehicles = false;  ///< whether detections of other vehicles of the team are used
};

/// At each tick the scans of its time, with the odometry and the fixes since the tick before.
class RangeSensor final : public Sensor {
 public:
  RangeSensor(SharedRangeRecordings recordings, const RangeSensorSettings& settings);
  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  struct Progress {
    std::size_t odometry = 0, fixes = 0, scans = 0;
    bool fix_given = false;
  };
  BodyObservation next(const RangeRecording& recording, Progress& done, double t) const;

  SharedRangeRecordings recordings_;
  RangeSensorSettings settings_;
  std::vector<Progress> done_;
};

/// Time of the first event that the vehicle could know of, s: odometry, scan or fix.
double start_time(const RangeRecording& recording);

/// The true place at a time, interpolated; nothing where the truth has a hole.
std::optional<RangeRecording::TimedPosition> true_position(const RangeRecording& recording, double t);

}  // namespace incognita
