// Parts of Example 4.1: the system `planar`, (4.11) and (4.12), its states and directions.
#pragma once

#include <vector>

#include "experiments/observability_claims.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita::observability_claims::planar {

inline constexpr double rounding = 1e-9;

/// World-centric: x, y, theta and x, y of each feature.
const Study& world(int features = 1, int anchors = 0, int segments = 3);

/// A vector of it with one feature.
Eigen::VectorXd five(double x, double y, double theta, double xf, double yf);

/// From the vehicle to the first feature.
Eigen::Vector2d r_of(const SystemPoint& point);

/// Everything turned about a point.
Eigen::VectorXd turn(const SystemPoint& point, const Eigen::Vector2d& about);

std::vector<Claim> anchor_claims();
std::vector<Claim> relative_claims();

}  // namespace incognita::observability_claims::planar
