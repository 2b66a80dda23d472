// Example 4.1, world-centric: the system `planar`, (4.11) and (4.12).
#pragma once

#include "experiments/observability_claims.hpp"

namespace incognita::observability_claims::planar {

/// States: x, y, theta and x, y of each feature.
inline const Study& world(int features = 1, int anchors = 0, int segments = 3) {
  return study({.system = "planar", .features = features, .anchors = anchors, .segments = segments});
}

/// A vector of it with one feature.
inline VectorXd five(double x, double y, double theta, double xf, double yf) {
  return (VectorXd(5) << x, y, theta, xf, yf).finished();
}

/// From the vehicle to the first feature.
inline Vector2d r_of(const SystemPoint& point) { return point.x.segment<2>(3) - point.x.head<2>(); }

std::vector<Claim> anchor_claims();
std::vector<Claim> relative_claims();

}  // namespace incognita::observability_claims::planar
