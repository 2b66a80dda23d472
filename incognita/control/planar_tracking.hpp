// Tracking of a moving reference by a planar vehicle, about its axle: Kanayama, Kimura, Miyazaki, Noguchi, "A
// stable tracking control method for an autonomous mobile robot", ICRA 1990.
//
//     v = v* cos(e_theta) + K_x e_x,    w = w* + v* (K_y e_y + K_theta sin(e_theta))
//
// with e the reference pose minus the vehicle pose, in vehicle axes. The law also controls the heading and
// needs no control point off the axle, but converges only for a reference that moves forwards.
#pragma once

#include "incognita/control/paths/reference.hpp"
#include "incognita/control/planar_command.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"

namespace incognita {

struct TrackingGains {
  double along_per_s = 1;    ///< K_x
  double across_per_m2 = 4;  ///< K_y
  double heading_per_m = 2;  ///< K_theta
};

/// Command of the axle's center, scaled as a whole to the limits.
PlanarCommand track(const planar::Pose<double>& axle, const Reference& reference, const TrackingGains& gains,
                    const PlanarLimits& limits);

}  // namespace incognita
