// Outlier rejection among the matches of one frame.
//
// One-point RANSAC (Civera, Grasa, Davison, Montiel, Journal of Field Robotics 2010) without sampling: each
// match in turn is the hypothesis, the innovations of the others are conditioned on it, and those inside the
// chi-square gate are counted. Everything is computed in measurement space from the joint innovation
// covariance, so the cost does not depend on the size of the map. The largest group then has to pass a
// leave-one-out test: each member must be consistent with all the others.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace incognita {

/// `residuals`: 2 numbers per match; `S`: their joint innovation covariance, 2n x 2n, both triangles. `gate`:
/// chi-square threshold with 2 degrees of freedom.
/// Returns per match whether it belongs to the consistent group. A single match does if its own innovation
/// passes the gate.
std::vector<bool> consistent_matches(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double gate);

/// The unconfirmed matches: re-observed (`returning`) landmarks that the other inliers predict with a sigma above
/// `max_sigma_px` along the least certain axis. A false match is likely in so large a region and cannot be detected
/// there: such matches cause false loop closures. The worst is removed first, and the test repeated without it.
/// `S`: as above; the masks and the result have one entry per match.
std::vector<bool> unconfirmed_matches(const Eigen::MatrixXd& S, const std::vector<bool>& agrees,
                                      const std::vector<bool>& returning, double max_sigma_px);

}  // namespace incognita
