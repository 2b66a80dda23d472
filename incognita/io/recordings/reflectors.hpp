// Reflective posts in a scan of a laser that measures how bright each echo is.
#pragma once

#include <span>
#include <vector>

#include "incognita/math/angles.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {

/// The defaults are the laser and the posts of the ACFR car park.
struct ReflectorSettings {
  double first_bearing_rad = radians(-90.0);  ///< of beam 0, positive to the left of straight ahead
  double step_rad = radians(0.5);             ///< from each beam to the next
  int widest_gap_beams = 2;                   ///< beams of one post are no further apart: 1 for neighbours
  double nearest_m = 1;                       ///< what is nearer is the vehicle itself
  double farthest_m = 30;
};

/// From right to left: groups of beams with an intensity above 0, each at its mean range and mean bearing.
/// Beams whose range is not finite do not count. Both spans are of one length, else std::invalid_argument.
std::vector<Detection> find_reflectors(std::span<const double> ranges_m, std::span<const double> intensities,
                                       const ReflectorSettings& settings = {});

}  // namespace incognita
