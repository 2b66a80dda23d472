// Which of the matches of one frame agree with each other.
//
// One-point RANSAC (Civera, Grasa, Davison, Montiel, Journal of Field Robotics 2010) without the chance:
// every match in turn is taken as right, the others' innovations are conditioned on it, and those inside the
// chi-square gate are counted. All of it happens in measurement space, from the joint innovation covariance,
// so the cost does not grow with the map. The largest group is then held to a leave-one-out test: each member
// must agree with all the others.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace incognita {

/// `residuals`: 2 numbers per match; `S`: their joint innovation covariance, 2n x 2n, both triangles.
/// `gate`: chi-square threshold with 2 degrees of freedom.
/// Returns, for each match, whether it is in the agreed group. A lone match agrees with itself if its own
/// innovation passes the gate.
///
/// `max_alone_sigma_px`: a match of which the others say no more than that it is within a larger standard
/// deviation, along the axis where they say least, is not taken. In so large a place chance finds something
/// alike, and nobody is there to disagree: so loops are closed wrongly.
std::vector<bool> agreeing_matches(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double gate,
                                   double max_alone_sigma_px = std::numeric_limits<double>::infinity());

}  // namespace incognita
