// Recordings of several vehicles, made on one clock, as the loop sees them.
#pragma once

#include <memory>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

/// In the order of the team; what one calls vehicle i is the i-th.
using SharedTeamRecording = std::shared_ptr<const std::vector<RangeRecording>>;

/// A tick for each time at which any of them scanned, from when all know how they move on, until `duration_s`
/// have passed.
class TeamReplayClock final : public Clock {
 public:
  TeamReplayClock(const SharedTeamRecording& recordings, double duration_s);
  Tick next() override;
  std::int64_t expected_frames() const override { return static_cast<std::int64_t>(times_.size()); }

 private:
  std::vector<double> times_;
  std::size_t done_ = 0;
};

/// The true place of each, where it is known: motion capture loses one vehicle and keeps the others. Commands
/// move nothing: what was recorded has happened.
class TeamReplayWorld final : public World {
 public:
  explicit TeamReplayWorld(SharedTeamRecording recordings) : recordings_(std::move(recordings)) {}
  std::optional<Truth> move(const Command& command, const Tick& tick) override;

 private:
  SharedTeamRecording recordings_;
};

class TeamReplaySensor final : public Sensor {
 public:
  /// `sees_vehicles`: whether what they saw of each other is told. Detections beyond `max_range_m` are left
  /// out.
  TeamReplaySensor(SharedTeamRecording recordings, bool sees_vehicles, double max_range_m);
  Observation look(const std::optional<Truth>& truth, const Tick& tick) override;

 private:
  SharedTeamRecording recordings_;
  bool sees_vehicles_;
  double max_range_m_;
  std::vector<std::size_t> odometry_done_, scans_done_;
};

}  // namespace incognita
