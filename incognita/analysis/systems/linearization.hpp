// A point of a system, and its linearization there.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// n states: those of the vehicle, then those of each landmark.
struct SystemPoint {
  Eigen::VectorXd x;        ///< n
  Eigen::VectorXd u;        ///< inputs, held constant
  Eigen::VectorXd anchors;  ///< constants of each anchor in turn
};

/// Linearization at a point: dx' = F dx, dz = H dx. m measurements: the vehicle's own, each landmark's, each
/// anchor's.
struct LinearizedSystem {
  Eigen::MatrixXd F;        ///< n x n
  Eigen::MatrixXd H;        ///< m x n
  Eigen::VectorXd sigma;    ///< m: of the measurement noise
  Eigen::MatrixXd F_terms;  ///< n x n: sum of magnitudes of the terms of each entry; rounding is 1e-16 of it
  Eigen::MatrixXd H_terms;  ///< m x n
};

}  // namespace incognita
