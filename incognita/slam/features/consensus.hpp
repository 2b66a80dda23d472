// Which of the matches of one frame agree with each other.
//
// One-point RANSAC (Civera, Grasa, Davison, Montiel, Journal of Field Robotics 2010) without the chance:
// every match in turn is taken as right, the others' innovations are conditioned on it, and those inside the
// chi-square gate are counted. All of it happens in measurement space, from the joint innovation covariance,
// so the cost does not grow with the map. The largest group is then held to a leave-one-out test: each member
// must agree with all the others.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace incognita {

/// `residuals`: 2 numbers per match; `S`: their joint innovation covariance, 2n x 2n, both triangles.
/// `gate`: chi-square threshold with 2 degrees of freedom.
/// Returns, for each match, whether it is in the agreed group. A lone match agrees with itself if its own
/// innovation passes the gate.
std::vector<bool> consistent_matches(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double gate);

/// Of the matches that agree and are `returning` those that nothing bears out: of which the others that agree
/// say no more than that they are within a standard deviation above `max_sigma_px`, along the axis where they
/// say least. In so large a place chance finds something alike, and nobody is there to disagree: so loops
/// are closed wrongly. The worst goes first, and those left are asked again without it.
/// `S`: as above; the masks and what is returned: one for each match.
std::vector<bool> unconfirmed_matches(const Eigen::MatrixXd& S, const std::vector<bool>& agrees,
                                      const std::vector<bool>& returning, double max_sigma_px);

}  // namespace incognita
