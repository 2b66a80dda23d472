// Stability of a plant controlled from its own filter's estimate: thesis (5.5).
//
//   plant    x+     = F x + G (u + v),    z+ = H x+ + w+
//   filter   x_hat+ = F x_hat + G u + K (z+ - H (F x_hat + G u)),    u = -L x_hat
//
//   [x+]   [F - G L      G L   ] [x]   [G            0] [v ]
//   [e+] = [0        F - K H F ] [e] + [G - K H G   -K] [w+],    e = x - x_hat
//
// The signs are those of (5.5), which are correct; its w_k is the measurement noise at k + 1. (5.23) prints
// the estimate where the recursion is that of its error. The zero block, i.e. the separation of control and
// estimation, holds only if the filter's F, G and H are those of the plant: a filter linearized at a wrong
// estimate has others.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Sizes: n states, m inputs, p measurements.
struct ControlledSystem {
  Eigen::MatrixXd F;  ///< n x n
  Eigen::MatrixXd G;  ///< n x m, for the input and its additive noise
  Eigen::MatrixXd H;  ///< p x n

  /// Throws std::invalid_argument, stating the sizes, if they are inconsistent.
  void check() const;
};

struct Stability {
  Eigen::VectorXcd eigenvalues;  ///< NaN if they could not be computed
  double spectral_radius = 0;    ///< the largest of their magnitudes

  explicit operator bool() const { return spectral_radius < 1; }
};

/// Stability of x+ = A x.
Stability stability_of(const Eigen::MatrixXd& A);

/// Stability of F - G L, with F n x n, G n x m and L m x n. Throws std::invalid_argument for other sizes.
Stability is_stabilizing(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G, const Eigen::MatrixXd& L);

/// The matrix of (5.5) for (x, e), 2n x 2n. L is m x n, K is n x p.
Eigen::MatrixXd closed_loop_matrix(const ControlledSystem& system, const Eigen::MatrixXd& L,
                                   const Eigen::MatrixXd& K);

/// The matrix of (5.5) that maps the noises (v, w+) to (x, e), 2n x (m + p).
Eigen::MatrixXd closed_loop_noise(const ControlledSystem& system, const Eigen::MatrixXd& K);

/// Joint transition matrix of plant and filter on (x, x_hat), 2n x 2n, computed by stepping both from each
/// unit vector, independently of the algebra of (5.5).
Eigen::MatrixXd joint_dynamics(const ControlledSystem& plant, const ControlledSystem& filter,
                               const Eigen::MatrixXd& L, const Eigen::MatrixXd& K);

/// Stability of the closed loop, compared with regulator and estimator, which were designed separately.
struct Separation {
  Stability whole;
  Stability regulator;  ///< F - G L of the filter's model
  Stability estimator;  ///< F - K H F of the filter's model
  double coupling = 0;  ///< coupling from the state into the estimation error, relative to the whole
  /// Largest distance between an eigenvalue of the whole and the nearest one of the parts.
  double spectral_distance = 0;
  bool holds = false;  ///< whether the whole has the eigenvalues of the parts
};

/// `tolerance`: limit of the spectral distance. Coinciding eigenvalues are accurate only to the square root
/// of the rounding, so it cannot be smaller.
Separation separation(const ControlledSystem& plant, const ControlledSystem& filter, const Eigen::MatrixXd& L,
                      const Eigen::MatrixXd& K, double tolerance = 1e-6);

}  // namespace incognita
