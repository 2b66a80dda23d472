#include "incognita/analysis/observability/closed_loop.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <vector>

#include "incognita/math/expect_size.hpp"

namespace incognita {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

void expect_gains(const ControlledSystem& s, const MatrixXd& L, const MatrixXd& K) {
  s.check();
  expect_size("L", L, s.G.cols(), s.F.rows());
  expect_size("K", K, s.F.rows(), s.H.rows());
}

VectorXcd joined(const VectorXcd& a, const VectorXcd& b) {
  VectorXcd both(a.size() + b.size());
  both << a, b;
  return both;
}

/// Greedily pairs each of `a` with the nearest remaining one of `b`; returns the largest distance of a pair.
double distance_between(const VectorXcd& a, const VectorXcd& b) {
  if (!a.allFinite() || !b.allFinite()) return std::numeric_limits<double>::infinity();
  std::vector<std::complex<double>> left(b.begin(), b.end());
  double largest = 0;
  for (const std::complex<double>& value : a) {
    const auto nearest = std::min_element(left.begin(), left.end(), [&](const auto& p, const auto& q) {
      return std::abs(p - value) < std::abs(q - value);
    });
    largest = std::max(largest, std::abs(*nearest - value));
    left.erase(nearest);
  }
  return largest;
}

}  // namespace

void ControlledSystem::check() const {
  expect_size("F", F, F.rows(), F.rows());
  expect_size("G", G, F.rows(), G.cols());
  expect_size("H", H, H.rows(), F.rows());
}

Stability stability_of(const MatrixXd& A) {
  expect_size("A", A, A.rows(), A.rows());
  Stability stability;
  if (A.size() == 0) return stability;
  const bool finite = A.allFinite();  // the solver requires finite entries
  const Eigen::EigenSolver<MatrixXd> solver(finite ? A : MatrixXd::Identity(A.rows(), A.rows()), false);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const bool found = finite && solver.info() == Eigen::Success;
  stability.eigenvalues = found ? VectorXcd(solver.eigenvalues()) : VectorXcd::Constant(A.rows(), unknown);
  stability.spectral_radius = found ? stability.eigenvalues.cwiseAbs().maxCoeff() : unknown;
  return stability;
}

Stability is_stabilizing(const MatrixXd& F, const MatrixXd& G, const MatrixXd& L) {
  expect_size("F", F, F.rows(), F.rows());
  expect_size("G", G, F.rows(), G.cols());
  expect_size("L", L, G.cols(), F.rows());
  return stability_of(F - G * L);
}

MatrixXd closed_loop_matrix(const ControlledSystem& s, const MatrixXd& L, const MatrixXd& K) {
  expect_gains(s, L, K);
  const Index n = s.F.rows();
  MatrixXd A(2 * n, 2 * n);
  A << s.F - s.G * L, s.G * L, MatrixXd::Zero(n, n), s.F - K * s.H * s.F;
  return A;
}

MatrixXd closed_loop_noise(const ControlledSystem& s, const MatrixXd& K) {
  s.check();
  expect_size("K", K, s.F.rows(), s.H.rows());
  const Index n = s.F.rows();
  MatrixXd B(2 * n, s.G.cols() + s.H.rows());
  B << s.G, MatrixXd::Zero(n, s.H.rows()), s.G - K * s.H * s.G, -K;
  return B;
}

MatrixXd joint_dynamics(const ControlledSystem& plant, const ControlledSystem& filter, const MatrixXd& L,
                        const MatrixXd& K) {
  expect_gains(plant, L, K);
  expect_gains(filter, L, K);
  const Index n = plant.F.rows();
  expect_size("the filter's F", filter.F, n, n);
  MatrixXd joint(2 * n, 2 * n);
  for (Index i = 0; i < 2 * n; ++i) {
    const VectorXd start = VectorXd::Unit(2 * n, i);
    const VectorXd x_hat = start.tail(n), u = -L * x_hat;
    const VectorXd x_next = plant.F * start.head(n) + plant.G * u;
    const VectorXd expected = filter.F * x_hat + filter.G * u;
    const VectorXd innovation = plant.H * x_next - filter.H * expected;
    joint.col(i) << x_next, expected + K * innovation;
  }
  return joint;
}

Separation separation(const ControlledSystem& plant, const ControlledSystem& filter, const MatrixXd& L,
                      const MatrixXd& K, double tolerance) {
  const MatrixXd joint = joint_dynamics(plant, filter, L, K);
  const Index n = plant.F.rows();
  const MatrixXd I = MatrixXd::Identity(n, n);
  MatrixXd to_error(2 * n, 2 * n);  // (x, x_hat) to (x, x - x_hat), its own inverse
  to_error << I, MatrixXd::Zero(n, n), I, -I;
  const MatrixXd transformed = to_error * joint * to_error;
  Separation answer;
  answer.whole = stability_of(transformed);
  answer.regulator = is_stabilizing(filter.F, filter.G, L);
  answer.estimator = stability_of(filter.F - K * filter.H * filter.F);
  const double scale = std::max(transformed.norm(), std::numeric_limits<double>::min());
  answer.coupling = transformed.bottomLeftCorner(n, n).norm() / scale;
  answer.spectral_distance = distance_between(
      answer.whole.eigenvalues, joined(answer.regulator.eigenvalues, answer.estimator.eigenvalues));
  answer.holds = answer.spectral_distance <= tolerance;
  return answer;
}

}  // namespace incognita
