// A planar vehicle's recorded range-bearing measurements, in memory: read from files or simulated.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/messages/observation.hpp"

namespace incognita {

struct RangeRecording {
  struct Scan {
    double t = 0;                          ///< s
    std::vector<Detection> detections;     ///< may be empty
    std::vector<Detection> vehicles = {};  ///< teammates, identified by their index from 0; on request
  };
  struct TimedPosition {
    double t = 0;                        ///< s
    Eigen::Vector2d position{0.0, 0.0};  ///< sensor position, world, m
    std::optional<double> heading_rad;   ///< from +x, positive to the left; GPS has none
  };
  struct Landmark {
    std::int64_t identity = Detection::unknown;
    Eigen::Vector2d position{0.0, 0.0};  ///< world, m
  };

  std::string format;                ///< `acfr`, `mrclam`, `tables` or `simulated`
  std::string vehicle;               ///< motion model of the odometry: `ackermann` or `differential-drive`
  std::vector<Odometry> odometry;    ///< in time order
  std::vector<Scan> scans;           ///< in time order, one per time
  std::vector<TimedPosition> truth;  ///< in time order; empty if unknown. Not available to estimators
  /// In time order, from an external sensor; a GPS may be both truth and fix.
  std::vector<TimedPosition> fixes;
  std::vector<Landmark> landmarks;  ///< surveyed, for evaluation and as anchors; empty if unknown
  std::vector<std::string> notes;   ///< messages for the user: what was assumed or skipped, with counts
  bool whole_us = false;            ///< all times are whole microseconds: with_rounded_stamps()
};

/// The recording with all times rounded to whole microseconds, so that its estimate depends neither on the digits nor on
/// the origin of the stamps.
RangeRecording with_rounded_stamps(RangeRecording recording);

}  // namespace incognita
