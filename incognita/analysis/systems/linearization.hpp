// A point of a system, and the system about it, in numbers.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// n states: the vehicle's, then those of each landmark in turn.
struct SystemPoint {
  Eigen::VectorXd x;        ///< n
  Eigen::VectorXd u;        ///< inputs, held
  Eigen::VectorXd anchors;  ///< constants of each anchor in turn
};

/// About a point: dx' = F dx, dz = H dx. m measurements: the vehicle's own, each landmark's, each anchor's.
struct Linearization {
  Eigen::MatrixXd F;        ///< n x n
  Eigen::MatrixXd H;        ///< m x n
  Eigen::VectorXd sigma;    ///< m, of the measurements' noise
  Eigen::MatrixXd F_terms;  ///< n x n: size of what was added up to each entry; its rounding is 1e-16 of it
  Eigen::MatrixXd H_terms;  ///< m x n
};

}  // namespace incognita
