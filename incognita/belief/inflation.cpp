#include "incognita/belief/inflation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "incognita/math/random.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;

struct Range {
  int first, size;
};

std::vector<Range> blocks_along(const MatrixXd& P, std::span<const int> sizes) {
  std::vector<Range> blocks;
  int n = 0;
  std::ostringstream list;
  for (const int size : sizes) {
    list << (n > 0 ? " + " : "") << size;
    blocks.push_back({n, size});
    n += size;
  }
  const bool positive = !sizes.empty() && std::ranges::min(sizes) > 0;
  if (positive && P.rows() == n && P.cols() == n) return blocks;
  std::ostringstream what;
  what << "a covariance of " << P.rows() << "x" << P.cols() << " has no blocks of " << list.str();
  throw std::invalid_argument(what.str());
}

/// The off-diagonal blocks of P, symmetrized.
MatrixXd correlations(const MatrixXd& P, const std::vector<Range>& blocks) {
  MatrixXd M = 0.5 * (P + P.transpose());
  for (const auto [first, size] : blocks) M.block(first, first, size, size).setZero();
  return M;
}

struct Polar {
  MatrixXd root;       ///< (G G')^1/2
  MatrixXd direction;  ///< orthonormal rows when G is wide; G = root * direction
};

Polar polar(const MatrixXd& G) {
  const Eigen::JacobiSVD<MatrixXd> svd(G.transpose(), Eigen::ComputeThinU | Eigen::ComputeThinV);
  const MatrixXd &U = svd.matrixU(), &V = svd.matrixV();
  const MatrixXd root = V * svd.singularValues().asDiagonal() * V.transpose();
  return {0.5 * (root + root.transpose()), V * U.transpose()};
}

/// Inflation of the diagonal blocks, feasible or nearly so, and the value of the dual.
struct Candidate {
  MatrixXd Q;
  double bound = 0;
};

/// Primal: minimize tr(Q) subject to Q >= M, Q block diagonal. Dual: maximize tr(M X) over X >= 0 with
/// identity diagonal blocks. X = V V' with orthonormal rows in each V_i. For fixed others the optimal V_i is
/// the polar factor of sum M_ij V_j; at the optimum the roots of these polar decompositions form Q.
class Ascent {
 public:
  Ascent(const MatrixXd& M, const std::vector<Range>& blocks) : M_(M), blocks_(blocks) {
    RandomStream random(1, "inflation");  // equal V_i could be a stationary point
    V_ = MatrixXd::NullaryExpr(M.rows(), columns(), [&] { return random.normal(); });
    for (const auto [first, size] : blocks_) set(first, size, V_.middleRows(first, size));
  }

  void sweep() {
    for (const auto [first, size] : blocks_) set(first, size, M_.middleCols(first, size).transpose() * V_);
  }

  Candidate candidate() const {
    const MatrixXd G = M_ * V_;
    Candidate candidate{MatrixXd::Zero(M_.rows(), M_.cols()), G.cwiseProduct(V_).sum()};
    for (const auto [first, size] : blocks_)
      candidate.Q.block(first, first, size, size) = polar(G.middleRows(first, size)).root;
    return candidate;
  }

 private:
  void set(int first, int size, const MatrixXd& G) { V_.middleRows(first, size) = polar(G).direction; }

  /// Enough columns that generically every local maximum is a global one (Boumal, Voroninski, Bandeira 2016):
  /// more than the square root of twice the number of constraints.
  int columns() const {
    int twice_constraints = 0, largest = 1;
    for (const auto [first, size] : blocks_) {
      twice_constraints += size * (size + 1);
      largest = std::max(largest, size);
    }
    const int enough = static_cast<int>(std::ceil(std::sqrt(twice_constraints))) + 1;
    return std::min(static_cast<int>(M_.rows()), std::max(enough, largest));
  }

  const MatrixXd& M_;
  const std::vector<Range>& blocks_;
  MatrixXd V_;
};

/// One covariance with its blocks, its off-diagonal part and its rounding error.
struct Problem {
  const MatrixXd& P;
  std::vector<Range> blocks;
  MatrixXd M;
  double tolerance;

  Problem(const MatrixXd& covariance, std::span<const int> sizes, const InflationSettings& settings)
      : P(covariance),
        blocks(blocks_along(P, sizes)),
        M(correlations(P, blocks)),
        tolerance(settings.tolerance) {}

  double n() const { return static_cast<double>(P.rows()); }

  /// Bound on the rounding error of an eigenvalue of a difference of matrices as large as P and Q.
  double rounding(const MatrixXd& Q) const {
    const double largest = P.diagonal().cwiseAbs().maxCoeff() + M.norm() + Q.norm();
    return 4 * n() * std::numeric_limits<double>::epsilon() * largest;
  }

  /// Whether `c` would be within the tolerance of its bound once made feasible; cheaper than inflated().
  bool is_good(const Candidate& c) const {
    const double left = tolerance * c.bound - (c.Q.trace() - c.bound);
    if (left < 0) return false;
    const MatrixXd shifted = c.Q - M + left / n() * MatrixXd::Identity(M.rows(), M.cols());
    return shifted.llt().info() == Eigen::Success;
  }

  /// Makes any Q feasible by adding the missing smallest eigenvalue of Q - M to its diagonal blocks.
  Inflation inflated(const Candidate& c, int sweeps) const {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(c.Q - M, Eigen::EigenvaluesOnly);
    const double margin = rounding(c.Q), lacks = std::max(0.0, margin - eigen.eigenvalues()[0]);
    Inflation result{MatrixXd::Zero(P.rows(), P.cols()), c.Q.trace() + n() * lacks, c.bound, sweeps, false};
    for (const auto [first, size] : blocks)
      result.P.block(first, first, size, size) = P.block(first, first, size, size) +
                                                 c.Q.block(first, first, size, size) +
                                                 lacks * MatrixXd::Identity(size, size);
    const double gap = result.trace_added - result.least_trace;
    result.converged = gap <= tolerance * result.least_trace + 2 * n() * margin;
    return result;
  }
};

/// [C C']^1/2 and [C' C]^1/2. This is optimal: with C = U S V', the product of [Q_1 -C; -C' Q_2] with the
/// semidefinite [UU' UV'; VU' VV'] has the trace tr(U'Q_1 U) + tr(V'Q_2 V) - 2 tr(S), which must not be negative.
Candidate closed_form(const Problem& problem) {
  const int size = problem.blocks[0].size, rest = problem.blocks[1].size;
  const MatrixXd C = problem.M.topRightCorner(size, rest);
  Candidate c{MatrixXd::Zero(problem.M.rows(), problem.M.cols()), 0};
  c.Q.topLeftCorner(size, size) = polar(C).root;
  c.Q.bottomRightCorner(rest, rest) = polar(C.transpose()).root;
  c.bound = c.Q.trace();
  return c;
}

Inflation ascended(const Problem& problem, const InflationSettings& settings) {
  constexpr int sweeps_between_looks = 10;
  Ascent ascent(problem.M, problem.blocks);
  for (int sweeps = 1;; ++sweeps) {
    ascent.sweep();
    const bool last = sweeps >= settings.max_sweeps;
    if (!last && sweeps % sweeps_between_looks != 0) continue;
    const Candidate candidate = ascent.candidate();
    if (last || problem.is_good(candidate)) return problem.inflated(candidate, sweeps);
  }
}

}  // namespace

Inflation decorrelate_all(const MatrixXd& P, std::span<const int> sizes, const InflationSettings& settings) {
  const Problem problem(P, sizes, settings);
  if (!P.allFinite()) throw std::invalid_argument("a covariance to be inflated is not finite");
  if (problem.M.isZero(0)) return {P, 0, 0, 0, true};
  if (sizes.size() == 2) return problem.inflated(closed_form(problem), 0);
  return ascended(problem, settings);
}

Inflation decorrelate_map(const MatrixXd& P, std::span<const int> sizes, const InflationSettings& settings) {
  const std::vector<Range> blocks = blocks_along(P, sizes);
  Inflation result{P, 0, 0, 0, true};
  if (blocks.size() == 1) return result;
  const int vehicle = blocks[0].size, map = static_cast<int>(P.rows()) - vehicle;
  result = decorrelate_all(P.bottomRightCorner(map, map), sizes.subspan(1), settings);
  MatrixXd whole = P;
  whole.bottomRightCorner(map, map) = result.P;
  result.P = std::move(whole);
  return result;
}

}  // namespace incognita
