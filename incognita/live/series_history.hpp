// The time series of the run so far, for viewers that join later.
#pragma once

#include <cstdint>
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
  explicit SeriesHistory(bool with_errors, std::size_t most_rows = 20000);

  void add(const Snapshot& snapshot);
  /// {"t": [...], "state": [...], "columns": {...}, "timing_ms": {...}, "paths": [...], "events": [...], "frames": n}
  std::string json() const;

 private:
  struct Position {
    std::optional<Eigen::Vector3d> estimate, truth;  ///< m, world
  };
  struct Event {
    std::int64_t frame;
    double t;
    std::string kind, text;
  };
  void add_events(const Snapshot& snapshot);
  void thin();

  mutable std::mutex mutex_;
  std::vector<std::string> names_;
  bool with_errors_;
  std::size_t most_rows_;
  std::int64_t frames_ = 0, stride_ = 1;
  std::vector<double> t_;
  std::vector<TrackingState> state_;
  std::vector<std::vector<double>> rows_, timing_ms_;
  std::vector<std::string> stages_;
  std::vector<Event> events_;
  std::vector<std::vector<Position>> positions_;  ///< of all bodies, per row
  std::set<std::int64_t> initialized_;            ///< landmarks so far
  TrackingState last_state_ = TrackingState::starting;
};

}  // namespace incognita
