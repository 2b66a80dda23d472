// Linear system with noise, and the properties of its Kalman filter: thesis Sections 3.1 and 3.2.
//
//   x_{k+1} = F x_k + G v_k,   z_k = H x_k + w_k,   v ~ N(0, Q), w ~ N(0, R)
//
// Sizes: n states, m process noises, p measurements. All matrices are dense, since the systems are small.
#pragma once

#include <Eigen/Core>
#include <string>

namespace incognita {

struct LinearSystem {
  Eigen::MatrixXd F;  ///< n x n
  Eigen::MatrixXd G;  ///< n x m
  Eigen::MatrixXd H;  ///< p x n
  Eigen::MatrixXd Q;  ///< m x m, positive semi-definite
  Eigen::MatrixXd R;  ///< p x p, positive definite

  /// Throws std::invalid_argument, stating the sizes, if they are inconsistent.
  void check() const;
};

/// K = P H' (H P H' + R)^-1, with P the prior covariance: (A.1.9).
Eigen::MatrixXd kalman_gain(const LinearSystem& system, const Eigen::MatrixXd& P);

/// Posterior covariance for that gain, in Joseph form (A.2.7).
Eigen::MatrixXd updated(const LinearSystem& system, const Eigen::MatrixXd& P, const Eigen::MatrixXd& K);

/// F P F' + G Q G': (A.2.4).
Eigen::MatrixXd predicted(const LinearSystem& system, const Eigen::MatrixXd& P);

/// F - K H F: dynamics of the estimation error, (3.2).
Eigen::MatrixXd error_dynamics(const LinearSystem& system, const Eigen::MatrixXd& K);

/// [G Q^1/2 | F G Q^1/2 | ... | F^(n-1) G Q^1/2], n x (n m): (3.3).
Eigen::MatrixXd controllability_matrix(const LinearSystem& system);

/// [H; H F; ...; H F^(n-1)], (n p) x n: (3.24).
Eigen::MatrixXd observability_matrix(const LinearSystem& system);

/// Rank by singular values, with the values that determined it.
struct Rank {
  int rank = 0;
  Eigen::VectorXd singular_values;  ///< in decreasing order
  double tolerance = 0;             ///< larger ones count
  /// Smallest counted over largest not counted; infinite if all count or the others are 0
  double gap = 0;
};

/// Tolerance: `relative` times the largest singular value.
Rank rank_of(const Eigen::MatrixXd& matrix, double relative = 1e-10);

struct RiccatiSettings {
  int max_iterations = 100'000;
  double tolerance = 1e-13;  ///< largest change of an entry in one step, relative to the largest entry
};

/// Steady state of a Kalman filter's covariance.
struct RiccatiLimit {
  Eigen::MatrixXd P;  ///< prior covariance
  Eigen::MatrixXd K;  ///< the corresponding gain
  bool settled = false;
  int iterations = 0;
  std::string reason;  ///< reason for stopping, with numbers
};

/// Iterates (2.18) from P0, the covariance before the first update.
RiccatiLimit iterate_riccati(const LinearSystem& system, const Eigen::MatrixXd& P0,
                             const RiccatiSettings& settings = {});

}  // namespace incognita
