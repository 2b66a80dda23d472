// Log-determinants, entropies and chi-square gates.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Natural logarithm of the determinant of a symmetric positive definite matrix. It is computed from the Cholesky
/// factor, so that it neither underflows nor overflows. NaN when the matrix is not positive definite.
double log_det(const Eigen::Ref<const Eigen::MatrixXd>& spd);

/// Entropy in nats of a Gaussian with `dimensions` dimensions: thesis (6.2).
double gaussian_entropy(double log_det_covariance, int dimensions);

/// Quantile of the chi-square distribution with `dof` degrees of freedom.
/// Throws std::invalid_argument unless dof >= 1 and 0 < probability < 1.
double chi_square_quantile(double probability, int dof);

}  // namespace incognita
