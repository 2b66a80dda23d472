// Simulated drive in circles among landmarks, to measure consistency.
//
// The plant is the differential drive of thesis (3.16) with l = 0, integrated along the arc of each odometry
// step. Its inputs are the commands plus white noise held for one step, and the odometry is the command. A
// filter with the same noise parameters thus has the exact model, and its only error is the linearization.
// (A plant that steps along the tangent drives half a step's turn, 0.005 rad, aside of its heading: a bias.)
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
