// Any recording as clock and world of the loop; its sensors are a SensorSet of what was recorded.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "incognita/world/world.hpp"

namespace incognita {

/// Ticks at recorded times; `dt` is 0 at the first.
class ReplayClock final : public Clock {
 public:
  /// `times`: s, increasing. `whole_us`: they are stamps in whole microseconds.
  explicit ReplayClock(std::vector<double> times, bool whole_us = false)
      : times_(std::move(times)), whole_us_(whole_us) {}
  Tick next() override;
  void state(StateArchive& archive) override;
  std::int64_t expected_frames() const override { return static_cast<std::int64_t>(times_.size()); }

 private:
  std::vector<double> times_;
  bool whole_us_;
  std::size_t done_ = 0;
};

/// The recorded truth of one body at a time, s; empty where it is unknown.
using RecordedTruth = std::function<std::optional<BodyTruth>(double t)>;

/// Commands have no effect on a recording.
class ReplayWorld final : public World {
 public:
  /// `truth`: one per body.
  explicit ReplayWorld(std::vector<RecordedTruth> truth) : truth_(std::move(truth)) {}
  /// A body of unknown truth is an empty one; empty if that of all bodies is unknown.
  std::optional<Truth> move(const Command& command, const Tick& tick) override;
  void state(StateArchive&) override {}  // it has none

 private:
  std::vector<RecordedTruth> truth_;
};

}  // namespace incognita
