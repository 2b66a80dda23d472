// Linearisers: from a model, the belief and an input to what the engine takes. Which one is used decides the
// filter.
//
// A motion model has `f(x, u, dt)`, `step(x, u, dt) -> {x, F, G}` and a `chart`; docs/add-a-motion-model.md.
// With constant F and G the analytic lineariser is the linear Kalman filter, else the extended one.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "incognita/belief/belief.hpp"

namespace incognita {

/// Root and pseudo-inverse of a covariance that may be singular: P = root root'. Told through its
/// correlations, so that metres and radians of very different size do not hide each other.
template <int n>
struct CovarianceFactors {
  using Square = Eigen::Matrix<double, n, n>;
  Square root, inverse;
  explicit CovarianceFactors(const Square& P) {
    constexpr double least = 1e-13;  // of a correlation matrix's eigenvalues, below which there is no spread
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

/// A vector as a chart takes it.
template <class Vector>
std::span<double> numbers(Vector& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// First order about the mean: (A.2.1)-(A.2.4). `Q`: input noise, held for dt.
template <class Motion, class InputNoise>
AffineMotion linearised(const Motion& motion, const Belief& belief, BlockId block,
                        const typename Motion::template Input<double>& u, const InputNoise& Q, double dt) {
  const auto step = motion.step(typename Motion::template State<double>(belief.mean(block)), u, dt);
  return {block, step.x, step.F, step.G * Q * step.G.transpose()};
}

/// Unscented transformation of the vehicle's states and input alone (Andrade-Cetto, Vidal-Calleja, Sanfeliu,
/// ICRA 2005): 2 (n + m) points of equal weight carry mean and covariance through f without derivatives. The
/// map follows by statistical regression, A = P_yx P_xx^+, so that the cost stays linear in it; what A does
/// not explain is noise.
template <class Motion, class InputNoise>
AffineMotion unscented(const Motion& motion, const Belief& belief, BlockId block,
                       const typename Motion::template Input<double>& u, const InputNoise& Q, double dt) {
  constexpr int n = Motion::error_size, m = Motion::input_size, count = 2 * (n + m);
  using State = typename Motion::template State<double>;
  using Square = Eigen::Matrix<double, n, n>;
  const Eigen::Matrix<double, n, n> P = belief.covariance(block);
  const CovarianceFactors<n> factors(P);
  const Square root = factors.root * std::sqrt(double(n + m));
  const Eigen::Matrix<double, m, m> input_root = CovarianceFactors<m>(Q).root * std::sqrt(double(n + m));
  const State mean = belief.mean(block), centre = motion.template f<double>(mean, u, dt);

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
    // From the centre moved by as much as the point: what is left is small, and no angle wraps
    State reference = centre;
    motion.chart.plus(numbers(reference), numbers(shift));
    motion.chart.minus(numbers(image), numbers(reference), numbers(moved));
    after.col(i) = shift + moved;
  }
  Eigen::Matrix<double, n, 1> offset = after.rowwise().mean();
  after.colwise() -= offset;
  State next = centre;
  motion.chart.plus(numbers(next), numbers(offset));
  const Square P_yy = after * after.transpose() / count, P_yx = after * before.transpose() / count;
  const Square A = P_yx * factors.inverse;
  return {block, next, A, P_yy - A * P * A.transpose()};
}

struct IterationSettings {
  int max_iterations = 10;
  double tolerance = 1e-8;  ///< largest change of an error of a block that is looked from or at
};

struct IterationReport {
  UpdateReport update;
  int iterations = 0;
  bool converged = false;  ///< else the cap was reached and the last linearisation used
};

/// Iterated update (Bell, Cathey 1993: Gauss-Newton on the posterior): linearises again where the update
/// would put the blocks that are looked from and at. `looks_at(belief)` gives the looks linearised about the
/// belief's means, the same measurements in the same order each time. The covariance is that of the last
/// linearisation.
template <class LooksAt>
IterationReport update_iterated(Belief& belief, std::span<const BlockId> blocks, LooksAt&& looks_at,
                                const IterationSettings& settings = {}) {
  IterationReport report;
  std::vector<BlockVector> prior, shift;
  for (const BlockId id : blocks) {
    prior.emplace_back(belief.mean(id));
    shift.emplace_back(BlockVector::Zero(belief.chart(id).tangent()));
  }
  const auto move_to = [&](const std::vector<BlockVector>& by) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      BlockVector mean = prior[i], delta = by[i];
      belief.chart(blocks[i]).plus(numbers(mean), numbers(delta));
      belief.set_mean(blocks[i], mean);
    }
  };
  std::vector<BlockVector> next(blocks.size()), zero(shift);
  for (;;) {
    move_to(shift);
    std::vector<AffineLook> looks = looks_at(belief);
    // z - h(x_i) - H_i (x_0 - x_i), and x_0 - x_i = -shift
    for (AffineLook& look : looks)
      for (int part = 0; part < look.part_count; ++part)
        for (std::size_t i = 0; i < blocks.size(); ++i)
          if (blocks[i] == look.parts[part].block) look.residual += look.parts[part].H * shift[i];
    move_to(zero);
    const bool usable = belief.correction(looks, blocks, next);
    double change = 0;
    for (std::size_t i = 0; usable && i < blocks.size(); ++i)
      change = std::max(change, (next[i] - shift[i]).cwiseAbs().maxCoeff());
    report.converged = usable && change <= settings.tolerance;
    if (!usable || report.converged || ++report.iterations >= settings.max_iterations) {
      report.update = belief.update(looks);
      return report;
    }
    shift = next;
  }
}

}  // namespace incognita
