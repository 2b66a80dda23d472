// The time series of the run so far, for viewers that join later.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Of bounded size: when it is full, every other frame is forgotten, and later ones are kept as rarely. May be used by
/// several threads.
class SeriesHistory {
 public:
  SeriesHistory(bool with_errors, std::size_t bodies, std::size_t most_rows = 20000);

  void add(const Snapshot& snapshot);
  /// {"t": [...], "state": [...], "columns": {...}, "timing_ms": {...}, "paths": [...], "events": [...], "frames": n,
  /// "frame_step": frames from one row to the next}
  std::string json() const;

 private:
  struct Event {
    std::int64_t frame;
    double t;
    std::string kind, text;
  };
  /// What json() copies, so that the loop does not wait while the text is written.
  struct Kept {
    std::int64_t frames = 0;  ///< of the run, kept or not
    /// A row is: t (s), the state's number, series_row, timing_ms, and of each body the estimated and the true position
    /// (m, world); NaN if unknown. One block of memory: many small rows would fragment the heap of a long run.
    std::vector<double> rows;
    std::vector<std::string> stages;
    std::deque<Event> events;
  };
  void begin(const Snapshot& first);
  void add_events(const Snapshot& snapshot);
  void add_row(const Snapshot& snapshot);
  void thin();

  mutable std::mutex mutex_;
  const std::vector<std::string> names_;
  const bool with_errors_;
  const std::size_t bodies_, most_rows_;
  Kept kept_;
  std::size_t width_ = 0;  ///< of a row
  std::int64_t stride_ = 1;
  std::set<std::int64_t> initialized_;  ///< landmarks so far
  TrackingState last_state_ = TrackingState::starting;
};

}  // namespace incognita
