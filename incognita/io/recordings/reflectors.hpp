// Detects reflective posts in a laser scan with echo intensities.
#pragma once

#include <span>
#include <vector>

#include "incognita/math/angles.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {

/// The defaults are for the laser and the posts of the ACFR car park.
struct ReflectorSettings {
  double first_bearing_rad = radians(-90.0);  ///< of beam 0, positive to the left
  double step_rad = radians(0.5);             ///< between successive beams
  int widest_gap_beams = 2;                   ///< largest index difference within a post; 1: neighbors
  double nearest_m = 1;                       ///< nearer echoes are from the vehicle itself
  double farthest_m = 30;
};

/// Posts from right to left: groups of beams with positive intensity, at their mean range and mean bearing.
/// Beams with non-finite range are ignored. Throws std::invalid_argument unless both spans have the same length.
std::vector<Detection> find_reflectors(std::span<const double> ranges_m, std::span<const double> intensities,
                                       const ReflectorSettings& settings = {});

}  // namespace incognita
