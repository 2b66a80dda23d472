// The standard deviation of a Gaussian in its worst direction.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace incognita {

/// Square root of the largest eigenvalue of a covariance; 0 where rounding makes it negative.
template <class Covariance>
double largest_sigma(const Eigen::MatrixBase<Covariance>& covariance) {
  const Eigen::SelfAdjointEigenSolver<typename Covariance::PlainObject> solver(covariance,
                                                                               Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

}  // namespace incognita
