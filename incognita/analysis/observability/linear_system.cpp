#include "incognita/analysis/observability/linear_system.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <limits>
#include <sstream>

#include "incognita/math/expect_size.hpp"

namespace incognita {
namespace {

/// Symmetric square root; negative eigenvalues due to rounding are set to zero.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& psd) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(psd);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

template <class... Parts>
std::string words(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace

void LinearSystem::check() const {
  expect_size("F", F, F.rows(), F.rows());
  expect_size("G", G, F.rows(), Q.rows());
  expect_size("H", H, R.rows(), F.rows());
  expect_size("Q", Q, Q.rows(), Q.rows());
  expect_size("R", R, R.rows(), R.rows());
}

Eigen::MatrixXd kalman_gain(const LinearSystem& s, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd S = s.H * P * s.H.transpose() + s.R;
  return S.llt().solve(s.H * P).transpose();
}

Eigen::MatrixXd updated(const LinearSystem& s, const Eigen::MatrixXd& P, const Eigen::MatrixXd& K) {
  const Eigen::MatrixXd I_KH = Eigen::MatrixXd::Identity(P.rows(), P.cols()) - K * s.H;
  return I_KH * P * I_KH.transpose() + K * s.R * K.transpose();
}

Eigen::MatrixXd predicted(const LinearSystem& s, const Eigen::MatrixXd& P) {
  return s.F * P * s.F.transpose() + s.G * s.Q * s.G.transpose();
}

Eigen::MatrixXd error_dynamics(const LinearSystem& s, const Eigen::MatrixXd& K) {
  return s.F - K * s.H * s.F;
}

Eigen::MatrixXd controllability_matrix(const LinearSystem& s) {
  s.check();
  const Eigen::Index n = s.F.rows(), m = s.G.cols();
  Eigen::MatrixXd C(n, n * m);
  Eigen::MatrixXd block = s.G * root_of(s.Q);
  for (Eigen::Index i = 0; i < n; ++i) {
    C.middleCols(i * m, m) = block;
    block = (s.F * block).eval();
  }
  return C;
}

Eigen::MatrixXd observability_matrix(const LinearSystem& s) {
  s.check();
  const Eigen::Index n = s.F.rows(), p = s.H.rows();
  Eigen::MatrixXd O(n * p, n);
  Eigen::MatrixXd block = s.H;
  for (Eigen::Index i = 0; i < n; ++i) {
    O.middleRows(i * p, p) = block;
    block = (block * s.F).eval();
  }
  return O;
}

Rank rank_of(const Eigen::MatrixXd& matrix, double relative) {
  Rank rank;
  if (matrix.size() == 0) return rank;
  rank.singular_values = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
  rank.tolerance = relative * rank.singular_values[0];
  rank.rank = static_cast<int>((rank.singular_values.array() > rank.tolerance).count());
  const bool all = rank.rank == rank.singular_values.size();
  const double left_out = all ? 0 : rank.singular_values[rank.rank];
  rank.gap = rank.rank > 0 && left_out > 0 ? rank.singular_values[rank.rank - 1] / left_out
                                           : std::numeric_limits<double>::infinity();
  return rank;
}

RiccatiLimit iterate_riccati(const LinearSystem& system, const Eigen::MatrixXd& P0,
                             const RiccatiSettings& settings) {
  system.check();
  expect_size("P0", P0, system.F.rows(), system.F.rows());
  RiccatiLimit limit;
  limit.P = P0;
  double change = 0;
  for (limit.iterations = 0; limit.iterations < settings.max_iterations;) {
    limit.K = kalman_gain(system, limit.P);
    Eigen::MatrixXd next = predicted(system, updated(system, limit.P, limit.K));
    next = (0.5 * (next + next.transpose())).eval();
    ++limit.iterations;
    if (!next.allFinite()) {
      limit.reason = words("not finite after ", limit.iterations, " steps");
      return limit;
    }
    change = (next - limit.P).cwiseAbs().maxCoeff() / std::max(next.cwiseAbs().maxCoeff(), 1e-300);
    limit.P = next;
    if (change > settings.tolerance) continue;
    limit.K = kalman_gain(system, limit.P);
    limit.settled = true;
    limit.reason = words("converged in ", limit.iterations, " steps");
    return limit;
  }
  limit.reason = words("still changes by ", change, " of its largest entry per step after ", limit.iterations,
                       " steps, the limit");
  return limit;
}

}  // namespace incognita
