// A simulated drive in circles among landmarks: what consistency is measured on.
//
// The plant is the differential drive of thesis (3.16) with l = 0, integrated along the arc of each odometry step; its
// inputs are the commanded ones plus white noise held for one step, and the odometry is the command. So a filter that
// is given the same noises has the right model, and what is left is its linearization.
#pragma once

#include <cstdint>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

struct PlanarLoopSettings {
  double duration_s = 500;
  double odometry_hz = 10;
  double scan_hz = 1;
  double speed_m_s = 1;
  double turn_rate_rad_s = 0.1;  ///< with the speed: circles of 10 m, eight of them
  int landmarks = 20;            ///< spread evenly around the circle, alternately inside and outside of it
  double landmark_offset_m = 4;  ///< from the circle
  double max_range_m = 8;        ///< of the sensor, which looks all around

  double sigma_speed_m_s = 0.1;  ///< of one step
  double sigma_turn_rate_rad_s = 0.1;
  double sigma_range_m = 0.1;
  double sigma_bearing_rad = 0.1;
  double sigma_fix_m = 0.2;  ///< of the external sensor, once per scan
};

/// The true start is (0, 0) with heading 0. Landmarks have identities and their true positions. Same
/// settings, same seed, same recording.
RangeRecording drive_planar_loop(const PlanarLoopSettings& settings, std::uint64_t seed);

}  // namespace incognita
