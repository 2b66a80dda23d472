// Linear quadratic regulators: thesis (5.1) to (5.4).
//
//   x_{k+1} = F x_k + G u_k,    u_k = -L_k x_k,    minimizing  sum of  x' Q1 x + u' Q2 u
//
//   L_k = (Q2 + G' T_{k+1} G)^-1 G' T_{k+1} F                                  (5.3)
//   T_k = Q1 + L_k' Q2 L_k + (F - G L_k)' T_{k+1} (F - G L_k)                  (5.4)
//
// The right-hand sides contain T_{k+1}, not T_k as printed: the recursion runs backwards from the end. x' T_k
// x is the remaining cost. Sizes: n states, m inputs; F n x n, G n x m, Q1 n x n, Q2 m x m, L m x n, T n x n.
// Wrong sizes and entries that are not finite throw std::invalid_argument.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

enum class RegulatorOutcome {
  converged,
  cost_not_definite,
  not_stabilizable,
  not_detectable,
  not_converged,
};

/// Description of the outcome for the user.
std::string_view sentence(RegulatorOutcome outcome);

/// Gains of a finite horizon.
struct HorizonGains {
  std::vector<Eigen::MatrixXd> L;  ///< L_0 first; empty unless the outcome is `converged`
  Eigen::MatrixXd T0;              ///< x_0' T0 x_0 is the total cost
  RegulatorOutcome outcome = RegulatorOutcome::not_converged;
  std::string reason;  ///< the sentence of the outcome, with numbers
};

/// Runs (5.3) and (5.4) backwards from T_end, the cost of the last state. Q1, Q2 and T_end need only be
/// positive semi-definite, as in the thesis, as long as Q2 + G' T G is definite.
HorizonGains finite_horizon_gains(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G,
                                  const Eigen::MatrixXd& Q1, const Eigen::MatrixXd& Q2,
                                  const Eigen::MatrixXd& T_end, int steps);

struct RegulatorSettings {
  int max_iterations = 60;   ///< doublings: the last one covers 2^60 steps
  double tolerance = 1e-12;  ///< largest change of T in a doubling, relative to its largest entry
};

/// Fixed point of (5.4), for an infinite horizon.
struct SteadyGain {
  Eigen::MatrixXd L;  ///< as T, empty unless the outcome is `converged`
  Eigen::MatrixXd T;
  int iterations = 0;
  double residual = 0;  ///< residual of (5.4) with the same T on both sides, relative to its terms
  RegulatorOutcome outcome = RegulatorOutcome::not_converged;
  std::string reason;  ///< the sentence of the outcome, with numbers and the critical mode
};

/// Steady-state gain. Systems without a stabilizing gain are rejected beforehand, and results that do not
/// solve (5.4) or do not stabilize afterwards. Modes within 1e-7 of the unit circle, or of being unreachable,
/// count as such, since coinciding eigenvalues are not computed more accurately.
SteadyGain steady_gain(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G, const Eigen::MatrixXd& Q1,
                       const Eigen::MatrixXd& Q2, const RegulatorSettings& settings = {});

}  // namespace incognita
