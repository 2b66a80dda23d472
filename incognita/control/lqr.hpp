// Linear quadratic regulators: thesis (5.1) to (5.4).
//
//   x_{k+1} = F x_k + G u_k,    u_k = -L_k x_k,    with the least  sum of  x' Q1 x + u' Q2 u
//
//   L_k = (Q2 + G' T_{k+1} G)^-1 G' T_{k+1} F                                  (5.3)
//   T_k = Q1 + L_k' Q2 L_k + (F - G L_k)' T_{k+1} (F - G L_k)                  (5.4)
//
// T on the right is T_{k+1}, not T_k as printed: the recursion runs back from the end. x' T_k x is what the
// rest of the way costs. Sizes: n states, m inputs; F n x n, G n x m, Q1 n x n, Q2 m x m, L m x n, T n x n.
// Sizes that do not fit, and entries that are not finite, throw std::invalid_argument.
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

/// What it means, for a person.
std::string_view sentence(RegulatorOutcome outcome);

/// Gains for a way of so many steps.
struct HorizonGains {
  std::vector<Eigen::MatrixXd> L;  ///< L_0 first; empty unless the outcome is `converged`
  Eigen::MatrixXd T0;              ///< x_0' T0 x_0 is what the whole way costs
  RegulatorOutcome outcome = RegulatorOutcome::not_converged;
  std::string reason;  ///< the sentence, with numbers
};

/// (5.3) and (5.4) from T_end, the cost of the last state, backwards. Q1, Q2 and T_end need only be positive
/// semi-definite, as the thesis says, while Q2 + G' T G is definite.
HorizonGains finite_horizon_gains(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G,
                                  const Eigen::MatrixXd& Q1, const Eigen::MatrixXd& Q2,
                                  const Eigen::MatrixXd& T_end, int steps);

struct RegulatorSettings {
  int max_iterations = 60;   ///< doublings: the last one reaches back 2^60 steps
  double tolerance = 1e-12;  ///< largest change of T in a doubling, relative to its largest entry
};

/// Where (5.4) settles for an endless way.
struct SteadyGain {
  Eigen::MatrixXd L;  ///< empty unless the outcome is `converged`, as T
  Eigen::MatrixXd T;
  int iterations = 0;
  double residual = 0;  ///< of (5.4) with the same T on both sides, relative to its terms
  RegulatorOutcome outcome = RegulatorOutcome::not_converged;
  std::string reason;  ///< the sentence, with the numbers and the mode that decided
};

/// Refuses what has no gain that stabilises, before it starts, and what it found unless it solves (5.4) and
/// stabilises. Modes count as on the unit circle, and as out of reach, within 1e-7: eigenvalues that coincide
/// are not known better.
SteadyGain steady_gain(const Eigen::MatrixXd& F, const Eigen::MatrixXd& G, const Eigen::MatrixXd& Q1,
                       const Eigen::MatrixXd& Q2, const RegulatorSettings& settings = {});

}  // namespace incognita
