// A vehicle on a plane and what it measured of landmarks, whole and in memory: read from files or simulated.
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
    double t = 0;                       ///< s
    std::vector<Detection> detections;  ///< none where the scan shows no landmark
    std::vector<Detection> vehicles =
        {};  ///< others of a team, the identity being which one, from 0; where asked for
  };
  struct TimedPosition {
    double t = 0;                        ///< s
    Eigen::Vector2d position{0.0, 0.0};  ///< world, m: of the sensor
    std::optional<double> heading_rad;   ///< from +x, positive to the left; GPS does not tell
  };
  struct Landmark {
    std::int64_t identity = Detection::unknown;
    Eigen::Vector2d position{0.0, 0.0};  ///< world, m
  };

  std::string format;                ///< `acfr`, `mrclam`, `tables` or `simulated`
  std::string vehicle;               ///< what the odometry's inputs are: `ackermann` or `differential-drive`
  std::vector<Odometry> odometry;    ///< in time order
  std::vector<Scan> scans;           ///< in time order, one per time
  std::vector<TimedPosition> truth;  ///< in time order; empty where it is not known. Never for the estimator
  std::vector<TimedPosition>
      fixes;  ///< what an external sensor told the vehicle, in time order; a GPS may be both
  std::vector<Landmark> landmarks;  ///< surveyed, for comparison and as anchors; empty where not known
  std::vector<std::string> notes;   ///< what was guessed, skipped or left out, with counts, for printing
};

}  // namespace incognita
