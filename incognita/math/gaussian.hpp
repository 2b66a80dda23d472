// Log-determinants, entropies and chi-square gates.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Natural logarithm of the determinant of a symmetric positive definite matrix, from its Cholesky factor, so
/// that it neither under- nor overflows. NaN when the matrix is not positive definite.
double log_det(const Eigen::Ref<const Eigen::MatrixXd>& spd);

/// Entropy in nats of a Gaussian of so many dimensions: thesis (6.2).
double gaussian_entropy(double log_det_covariance, int dimensions);

/// The value that a chi-square variable of `dof` degrees of freedom stays below with the given probability.
/// Throws std::invalid_argument unless dof >= 1 and 0 < probability < 1.
double chi_square_quantile(double probability, int dof);

}  // namespace incognita
