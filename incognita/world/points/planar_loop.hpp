// Simulated drive in circles among landmarks, to measure consistency.
//
// The plant is the differential drive of thesis (3.16) with l = 0, stepped along its tangent at the rate of the odometry;
// its inputs are the commanded ones plus white noise held for one step, and the odometry is the command. A filter with
// the same noises has the right model but for its linearization and for the arc that it follows in a step (0.5 mm aside).
#pragma once

#include <cstdint>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

struct PlanarLoopSettings {
  double duration_s = 500;
  double odometry_hz = 10;
  double scan_hz = 1;
  double speed_m_s = 1;
  double turn_rate_rad_s = 0.1;  ///< radius with this speed: 10 m; eight circles
  int landmarks = 20;            ///< evenly around the circle, alternately inside and outside of it
  double landmark_offset_m = 4;  ///< distance from the circle
  double max_range_m = 8;        ///< sensor range, in all directions

  double sigma_speed_m_s = 0.1;  ///< per odometry step
  double sigma_turn_rate_rad_s = 0.1;
  double sigma_range_m = 0.1;
  double sigma_bearing_rad = 0.1;
  double sigma_fix_m = 0.2;  ///< noise of the position fixes, one per scan
};

/// The true start is (0, 0) with heading 0. Landmarks have identities and their true positions. Equal
/// settings and seeds give equal recordings.
RangeRecording drive_planar_loop(const PlanarLoopSettings& settings, std::uint64_t seed);

}  // namespace incognita
