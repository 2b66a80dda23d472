// What is still to be mapped after a plan: information that later views would add, worth less the longer the way to them.
//
// A plan reaches only a few actions ahead. Without this term all plans are equal where nothing new is within their reach, and the
// body stays where it has mapped everything.
#pragma once

#include <Eigen/Core>
#include <span>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/plan/imagined_map.hpp"

namespace incognita {

/// How a body gets to a view of a landmark.
struct Reach {
  double speed_m_s = 0.3;
  double turn_rate_rad_s = 0.2;
  double half_view_rad = 0.5;  ///< angle to the optical axis within which a landmark is in view
  double distance_m = 1.8;     ///< from which landmarks lie so far apart in the image that each is mapped
};

/// Time until a camera can view a landmark, s: it moves and turns at once, and nothing is in its way. `position`: of the camera,
/// world, m; `ahead`: its optical axis, world, of length 1.
double time_to_view_s(const Eigen::Vector3d& position, const Eigen::Vector3d& ahead,
                      const ExpectedLandmark& landmark, const Reach& reach);

/// Nats: the sum, over the expected landmarks, of probability * missing information * exp(-(start_s + time to view it) / discount_s); ours. `state`
/// begins with the position and the orientation of the camera.
double information_to_go(const BlockVector& state, std::span<const ExpectedLandmark> expected,
                         const PlannedMap& map, const ImaginedMap& imagined, const Resolution& resolution,
                         const Reach& reach, double start_s, double discount_s);

}  // namespace incognita
