// Replay of range-bearing recordings with a common clock: clock, sensor and, where known, truth.
#pragma once

#include <memory>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// One per vehicle; teammate detections refer to vehicles by their index here.
using SharedRangeRecordings = std::shared_ptr<const std::vector<RangeRecording>>;

/// One tick per scan time of any recording, for `duration_s` from the start. The start is the first event of
/// a single recording, and for several the first time at which all have odometry.
class RangeClock final : public Clock {
 public:
  RangeClock(const SharedRangeRecordings& recordings, double duration_s);
  Tick next() override;
  std::int64_t expected_frames() const override { return static_cast<std::int64_t>(times_.size()); }

 private:
  std::vector<double> times_;
  std::size_t done_ = 0;
};

/// True pose of each vehicle where known, interpolated between two poses at most 0.5 s apart. Commands have
/// no effect on a recording.
class RangeWorld final : public World {
 public:
  explicit RangeWorld(SharedRangeRecordings recordings) : recordings_(std::move(recordings)) {}
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SharedRangeRecordings recordings_;
};

/// Position fixes of a recording that the vehicle receives.
enum class Fixes { none, first, all };

struct RangeSensorSettings {
  double max_range_m = 1e9;  ///< detections beyond are dropped
  Fixes fixes = Fixes::none;
  bool measures_vehicles = false;  ///< whether detections of teammates are used
};

/// At each tick: the scans at its time, and the odometry and fixes since the last tick.
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

/// Time of the first event available to the vehicle, s: odometry, scan or fix.
double start_time(const RangeRecording& recording);

/// True position at a time, interpolated; empty within gaps of the truth.
std::optional<RangeRecording::TimedPosition> true_position(const RangeRecording& recording, double t);

}  // namespace incognita
