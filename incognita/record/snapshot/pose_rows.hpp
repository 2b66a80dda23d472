// Poses and covariances as text rows.
#pragma once

#include <string>

#include "incognita/analysis/evaluation/pose_consistency.hpp"

namespace incognita {

/// `t x y z qx qy qz qw`
std::string tum_row(const StampedPose& pose);
/// First line of an estimate.tum or truth.tum.
std::string tum_header(const std::string& body, bool oriented = true);

/// t and a row-major 6x6 covariance, order x y z rotX rotY rotZ.
std::string covariance_row(double t, const PoseCovariance& covariance);
std::string covariance_header();

}  // namespace incognita
