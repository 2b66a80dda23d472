// Linearization of a motion model; the choice determines the filter. `belief` is in any form: belief.hpp,
// information_belief.hpp, any_belief.hpp.
//
// A motion model has `f(x, u, dt)`, `step(x, u, dt) -> {x, F, G}` and a `chart`; docs/add-a-motion-model.md.
// With constant F and G the analytic linearization is the linear Kalman filter, otherwise the EKF.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "incognita/belief/belief.hpp"

namespace incognita {

/// Square root (P = root root') and pseudo-inverse of a covariance that may be singular. Computed from the
/// correlation matrix, so that different units (meters, radians) do not affect the rank decision.
template <int n>
struct CovarianceFactors {
  using Square = Eigen::Matrix<double, n, n>;
  Square root, inverse;
  explicit CovarianceFactors(const Square& P) {
    constexpr double least = 1e-13;  // correlation eigenvalues below this count as zero
    Eigen::Matrix<double, n, 1> sigma = P.diagonal().cwiseMax(0).cwiseSqrt();
    for (double& s : sigma)
      if (!(s > 0)) s = 1;
    const Square C = sigma.cwiseInverse().asDiagonal() * P * sigma.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Square> eigen(C);
    const auto values = eigen.eigenvalues().array();
    const Eigen::Matrix<double, n, 1> roots = values.max(0.0).sqrt();
    const Eigen::Matrix<double, n, 1> inverses = (values > least).select(values.inverse(), 0.0);
    const Square& V = eigen.eigenvectors();
    root = sigma.asDiagonal() * V * roots.asDiagonal();
    inverse = sigma.cwiseInverse().asDiagonal() * V * inverses.asDiagonal() * V.transpose() *
              sigma.cwiseInverse().asDiagonal();
  }
};

/// View of a vector for Chart::plus and Chart::minus.
template <class Vector>
std::span<double> numbers(Vector& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// First-order linearization about the mean: (A.2.1)-(A.2.4). `Q`: covariance of the input noise, held for dt.
template <class Motion, class Form, class InputNoise>
LinearizedMotion linearized(const Motion& motion, const Form& belief, BlockId block,
                            const typename Motion::template Input<double>& u, const InputNoise& Q,
                            double dt) {
  const auto step = motion.step(typename Motion::template State<double>(belief.mean(block)), u, dt);
  return {block, step.x, step.F, step.G * Q * step.G.transpose()};
}

/// Unscented transform of the vehicle state and input only (Andrade-Cetto, Vidal-Calleja, Sanfeliu, ICRA
/// 2005): 2 (n + m) points of equal weight propagate mean and covariance through f without derivatives. The
/// cross covariance with the map follows by statistical regression, A = P_yx P_xx^+, so that the cost stays
/// linear in the map; the residual of the regression is noise.
template <class Motion, class Form, class InputNoise>
LinearizedMotion unscented(const Motion& motion, const Form& belief, BlockId block,
                           const typename Motion::template Input<double>& u, const InputNoise& Q, double dt) {
  constexpr int n = Motion::error_size, m = Motion::input_size, count = 2 * (n + m);
  using State = typename Motion::template State<double>;
  using Square = Eigen::Matrix<double, n, n>;
  const Eigen::Matrix<double, n, n> P = belief.covariance(block);
  const CovarianceFactors<n> factors(P);
  const Square root = factors.root * std::sqrt(double(n + m));
  const Eigen::Matrix<double, m, m> input_root = CovarianceFactors<m>(Q).root * std::sqrt(double(n + m));
  const State mean = belief.mean(block), center = motion.template f<double>(mean, u, dt);

  Eigen::Matrix<double, n, count> before = Eigen::Matrix<double, n, count>::Zero(), after;
  for (int i = 0; i < count; ++i) {
    const int axis = i / 2;
    const double side = i % 2 ? -1 : 1;
    typename Motion::template Input<double> input = u;
    if (axis < n)
      before.col(i) = side * root.col(axis);
    else
      input += side * input_root.col(axis - n);
    State point = mean;
    Eigen::Matrix<double, n, 1> shift = before.col(i), moved;
    motion.chart.plus(numbers(point), numbers(shift));
    State image = motion.template f<double>(point, input, dt);
    // Relative to the center shifted by the same amount: the difference is small, so that no angle wraps
    State reference = center;
    motion.chart.plus(numbers(reference), numbers(shift));
    motion.chart.minus(numbers(image), numbers(reference), numbers(moved));
    after.col(i) = shift + moved;
  }
  Eigen::Matrix<double, n, 1> offset = after.rowwise().mean();
  after.colwise() -= offset;
  State next = center;
  motion.chart.plus(numbers(next), numbers(offset));
  const Square P_yy = after * after.transpose() / count, P_yx = after * before.transpose() / count;
  const Square A = P_yx * factors.inverse;
  return {block, next, A, P_yy - A * P * A.transpose()};
}

}  // namespace incognita
