// Tracking of a moving reference by a planar vehicle, about its axle: Kanayama, Kimura, Miyazaki, Noguchi, "A
// stable tracking control method for an autonomous mobile robot", ICRA 1990.
//
//   v = v* cos(e_theta) + K_x e_x,    w = w* + v* (K_y e_y + K_theta sin(e_theta))
//
// with e the reference's pose less the vehicle's, in the vehicle's axes. It holds the heading too, and needs
// no point off the axle; but only a reference that moves forwards draws it in.
#pragma once

#include "incognita/control/planar_command.hpp"
#include "incognita/control/reference.hpp"
#include "incognita/models/planar_vehicle.hpp"

namespace incognita {

struct TrackingGains {
  double along_per_s = 1;    ///< K_x
  double across_per_m2 = 4;  ///< K_y
  double heading_per_m = 2;  ///< K_theta
};

/// Of the middle of the axle. Within the limits, shrunk as a whole.
PlanarCommand track(const planar::Pose<double>& axle, const Reference& reference, const TrackingGains& gains,
                    const PlanarLimits& limits);

}  // namespace incognita
