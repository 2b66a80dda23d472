// Fills a RangeRecording row by row and validates the rows, whatever file format they come from.
#pragma once

#include <string>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// `where` is "file:line" or similar. All functions except skip() and note() throw InputError beginning with
/// it for an invalid row: decreasing times, an angle in degrees. Numbers are finite unless stated otherwise.
class RangeRecordingBuilder {
 public:
  /// `vehicle` as in RangeRecording.
  RangeRecordingBuilder(std::string format, std::string vehicle);

  void add_odometry(const std::string& where, const Odometry& odometry);
  /// A pose increment (m, m, rad; axes of the pose before) between two times, with its covariance.
  void add_increment(const std::string& where, double from, double to, const Eigen::Vector3d& increment,
                     const Eigen::Matrix3d& cov);
  /// The last increment ends at `t`, from where its velocity is held, as that of other readings.
  void end_increments(const std::string& where, double t);
  /// Begins a scan, or continues the last one if the time is the same.
  void add_scan(const std::string& where, double t);
  /// Adds to the last scan. Skipped if range or bearing is not finite or the range is not positive.
  void add_detection(const std::string& where, Detection detection);
  /// The same for the detection of another vehicle.
  void add_vehicle_detection(const std::string& where, Detection detection);
  void add_truth(const std::string& where, const RangeRecording::TimedPosition& reading);
  void add_fix(const std::string& where, const RangeRecording::TimedPosition& reading);
  void add_landmark(const std::string& where, const RangeRecording::Landmark& landmark);

  /// Counts a row that is left out; finish() notes the count of each kind and the first location.
  void skip(const std::string& kind, const std::string& where);
  void note(std::string text) { recording_.notes.push_back(std::move(text)); }

  /// Throws InputError beginning with `where` if there is no odometry or no scan, or if their times do not overlap.
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
