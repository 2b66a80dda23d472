// Whether a plant that is steered by what its own filter believes is stable: thesis (5.5).
//
//   plant    x+     = F x + G (u + v),    z+ = H x+ + w+
//   filter   x_hat+ = F x_hat + G u + K (z+ - H (F x_hat + G u)),    u = -L x_hat
//
//   [x+]   [F - G L      G L   ] [x]   [G            0] [v ]
//   [e+] = [0        F - K H F ] [e] + [G - K H G   -K] [w+],    e = x - x_hat
//
// These are the signs that (5.5) prints, and they are right; its w_k is the noise of the measurement at k
// + 1. (5.23) prints the estimate where the recursion is that of its error. The zero block, and with it the
// separation of control from estimation, stands only while the filter's F, G and H are those of the plant:
// a filter linearised at a wrong estimate has others.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// Sizes: n states, m inputs, p measurements.
struct ControlledSystem {
  Eigen::MatrixXd F;  ///< n x n
  Eigen::MatrixXd G;  ///< n x m, of the input and of the noise that is added to it
  Eigen::MatrixXd H;  ///< p x n

  /// Throws std::invalid_argument, with the sizes, when they do not fit each other.
  void check() const;
};

struct Stability {
  Eigen::VectorXcd eigenvalues;  ///< NaN where they could not be found
  double spectral_radius = 0;    ///< the largest of their magnitudes

  explicit operator bool() const { return spectral_radius < 1; }
};

/// Of x+ = A x.
Stability stability_of(const Eigen::MatrixXd& A);

/// Of F - G L, with F n x n, G n x m and L m x n. Throws std::invalid_argument when these are not their
/// sizes.
Stability is_stabilizing(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G, const Eigen::MatrixXd& L);

/// The matrix of (5.5) on (x, e), 2n x 2n. L is m x n, K is n x p.
Eigen::MatrixXd closed_loop_matrix(const ControlledSystem& system, const Eigen::MatrixXd& L,
                                   const Eigen::MatrixXd& K);

/// What the noises (v, w+) do to (x, e) in (5.5), 2n x (m + p).
Eigen::MatrixXd closed_loop_noise(const ControlledSystem& system, const Eigen::MatrixXd& K);

/// How plant and filter together move on, on (x, x_hat), 2n x 2n: both stepped from each unit vector, without
/// any of the algebra of (5.5).
Eigen::MatrixXd joint_dynamics(const ControlledSystem& plant, const ControlledSystem& filter,
                               const Eigen::MatrixXd& L, const Eigen::MatrixXd& K);

/// The whole, as it moves, beside the two parts that were designed apart.
struct Separation {
  Stability whole;
  Stability regulator;  ///< F - G L of the filter's model
  Stability estimator;  ///< F - K H F of the filter's model
  double coupling = 0;  ///< of the state into the error of its estimate, relative to the whole
  double spectral_distance =
      0;               ///< largest between an eigenvalue of the whole and that of the parts it is nearest
  bool holds = false;  ///< the whole has the eigenvalues of the parts
};

/// `tolerance` is of the spectral distance. Eigenvalues that coincide are only known to the square root of
/// the rounding, which is why it is not smaller.
Separation separation(const ControlledSystem& plant, const ControlledSystem& filter, const Eigen::MatrixXd& L,
                      const Eigen::MatrixXd& K, double tolerance = 1e-6);

}  // namespace incognita
