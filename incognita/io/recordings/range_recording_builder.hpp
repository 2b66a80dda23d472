// Fills a RangeRecording row by row and holds the rows to what it promises, whatever file they come from.
#pragma once

#include <string>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// `where` is "file:line" or the like. All but skip() and note() throw InputError beginning with it when the
/// row cannot be: a time before the last one's, an angle in degrees. Numbers are finite unless said
/// otherwise.
class RangeRecordingBuilder {
 public:
  /// `vehicle` as in RangeRecording.
  RangeRecordingBuilder(std::string format, std::string vehicle);

  void add_odometry(const std::string& where, const Odometry& odometry);
  /// Begins a scan, or goes on with the last one when the time is the same.
  void add_scan(const std::string& where, double t);
  /// Into the last scan. Skipped where range or bearing is not finite, or the range not positive.
  void add_detection(const std::string& where, Detection detection);
  /// The same, of another vehicle.
  void add_vehicle_detection(const std::string& where, Detection detection);
  void add_truth(const std::string& where, const RangeRecording::TimedPosition& reading);
  void add_fix(const std::string& where, const RangeRecording::TimedPosition& reading);
  void add_landmark(const std::string& where, const RangeRecording::Landmark& landmark);

  /// Counts a row that is left out; finish() notes how many of each kind there were, and where the first.
  void skip(const std::string& kind, const std::string& where);
  void note(std::string text) { recording_.notes.push_back(std::move(text)); }

  /// Throws InputError beginning with `where` when there is no odometry or no scan, or when their times have
  /// nothing in common.
  RangeRecording finish(const std::string& where);

 private:
  void note_clocks();
  struct Skipped {
    std::string kind;
    std::string first;
    int count;
  };
  void add_detection(const std::string& where, Detection detection,
                     std::vector<Detection> RangeRecording::Scan::*to);

  RangeRecording recording_;
  std::vector<Skipped> skipped_;
};

}  // namespace incognita
