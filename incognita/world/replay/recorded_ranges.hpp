// Recorded ranges and bearings of one vehicle or of a team, as parts of the loop.
#pragma once

#include <memory>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"
#include "incognita/world/replay/replay.hpp"
#include "incognita/world/sensor_set.hpp"

namespace incognita {

/// One per vehicle; teammate detections refer to vehicles by their index here.
using SharedRangeRecordings = std::shared_ptr<const std::vector<RangeRecording>>;

/// Position fixes of a recording that the vehicle receives.
enum class Fixes { none, first, all };

struct RangeSensorSettings {
  double max_range_m = 1e9;  ///< detections beyond are dropped
  Fixes fixes = Fixes::none;
  bool measures_vehicles = false;  ///< whether detections of teammates are used
};

/// At each tick: the scans at its time, and the odometry and fixes since the last tick.
class RecordedRanges final : public BodySensor {
 public:
  RecordedRanges(SharedRangeRecordings recordings, std::size_t vehicle, const RangeSensorSettings& settings);
  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive& archive) override;

 private:
  void add_readings(double t, BodyObservation& observation);
  void add_scans(double t, BodyObservation& observation);

  SharedRangeRecordings recordings_;
  const RangeRecording* recording_;  ///< of its vehicle
  RangeSensorSettings settings_;
  std::size_t odometry_ = 0, fixes_ = 0, scans_ = 0;  ///< used so far
  bool fix_given_ = false;
};

/// The sensors of all vehicles.
SensorSet recorded_ranges(const SharedRangeRecordings& recordings, const RangeSensorSettings& settings);

/// Scan times of all recordings, for `duration_s` from the start: the first event of a single recording, and for
/// several the first time at which all have odometry.
std::vector<double> scan_times(const std::vector<RangeRecording>& recordings, double duration_s);

/// The truth of each vehicle, interpolated between two poses at most 0.5 s apart. In a team only poses with a heading
/// count; a single vehicle may have a GPS, which measures none.
std::vector<RecordedTruth> recorded_truths(const SharedRangeRecordings& recordings);

/// Time of the first event available to the vehicle, s: odometry, scan or fix.
double start_time(const RangeRecording& recording);

/// True position at a time, interpolated; empty within gaps of the truth.
std::optional<RangeRecording::TimedPosition> true_position(const RangeRecording& recording, double t);

}  // namespace incognita
