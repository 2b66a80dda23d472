// The iterated EKF update: relinearizes at the updated mean until convergence. `belief` is in any form:
// belief.hpp, information_belief.hpp, any_belief.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "incognita/belief/linearize.hpp"
#include "incognita/belief/linearized.hpp"
#include "incognita/belief/update_report.hpp"
#include "incognita/math/chart.hpp"

namespace incognita {

struct IterationSettings {
  int max_iterations = 10;
  double tolerance = 1e-8;      ///< largest change of an error of the iterated blocks at convergence
  double tolerance_sigmas = 0;  ///< or of that error over its prior sigma; the looser of the two applies
};

struct IterationReport {
  UpdateReport update;
  int iterations = 0;
  bool converged = false;  ///< false: the last linearization at the iteration limit was used
};

/// d(y) / d(e) of x (+) (shift + e) = (x (+) shift) (+) y at e = 0: transforms an error from the chart at x
/// to the chart at x (+) shift. The identity for flat charts; for charts with a quaternion (whose right
/// Jacobian it contains) by central differences, accurate to 1e-10.
inline BlockMatrix chart_transition_jacobian(const Chart& chart, const BlockVector& x,
                                             const BlockVector& shift) {
  constexpr double h = 1e-5;
  const int n = chart.tangent();
  if (chart.ambient() == n) return BlockMatrix::Identity(n, n);
  BlockMatrix J(n, n);
  for (int k = 0; k < n; ++k) {
    BlockVector ahead = x, behind = x, further = shift, less = shift, moved(n);
    further[k] += h, less[k] -= h;
    chart.plus(numbers(ahead), numbers(further));
    chart.plus(numbers(behind), numbers(less));
    chart.minus(numbers(ahead), numbers(behind), numbers(moved));
    J.col(k) = moved / (2 * h);
  }
  return J;
}

/// Prior means and accumulated shifts of the blocks that the measurements depend on.
struct IteratedBlocks {
  std::vector<BlockId> ids;
  std::vector<BlockVector> prior, shift;
  std::vector<BlockMatrix> J;  ///< from chart_transition_jacobian()

  template <class Form>
  IteratedBlocks(const Form& belief, std::span<const BlockId> blocks)
      : ids(blocks.begin(), blocks.end()), J(ids.size()) {
    for (const BlockId id : ids) {
      prior.emplace_back(belief.mean(id));
      shift.emplace_back(BlockVector::Zero(belief.chart(id).tangent()));
    }
  }

  template <class Form>
  void move_to(Form& belief, const std::vector<BlockVector>& by) const {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      BlockVector mean = prior[i], delta = by[i];
      belief.chart(ids[i]).plus(numbers(mean), numbers(delta));
      belief.set_mean(ids[i], mean);
    }
  }

  /// Residual about the prior: z - h(x_i) - H_i (x_0 - x_i), with x_0 - x_i = -shift.
  void express_at_prior(LinearizedMeasurement& measurement) const {
    for (int part = 0; part < measurement.part_count; ++part)
      for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] != measurement.parts[part].block) continue;
        measurement.parts[part].H = (measurement.parts[part].H * J[i]).eval();
        measurement.residual += measurement.parts[part].H * shift[i];
      }
  }

  /// Largest change of the shift relative to its tolerance; converged at 1 or below.
  template <class Form>
  double largest_change(const Form& belief, const std::vector<BlockVector>& next,
                        const IterationSettings& settings) const {
    double most = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const BlockVector variances = belief.covariance(ids[i]).diagonal().cwiseMax(0);
      for (Eigen::Index k = 0; k < variances.size(); ++k) {
        const double tolerance_ =
            std::max(settings.tolerance, settings.tolerance_sigmas * std::sqrt(variances[k]));
        most = std::max(most, std::abs(next[i][k] - shift[i][k]) / tolerance_);
      }
    }
    return most;
  }
};

/// Iterated update (Bell, Cathey 1993: Gauss-Newton on the posterior): relinearizes at the updated means of
/// `blocks`. `linearize_at(belief)` returns the measurements linearized at the belief's means, in the same
/// order each time; one without parts is not available there and keeps its previous linearization. The
/// posterior covariance is that of the last linearization.
///
/// The prior and every step are expressed in the charts at the prior means, so each Jacobian with respect to
/// an error at the current means is transformed back to them.
template <class Form, class Linearizer>
IterationReport update_iterated(Form& belief, std::span<const BlockId> blocks, Linearizer&& linearize_at,
                                const IterationSettings& settings = {}) {
  IterationReport report;
  IteratedBlocks at(belief, blocks);
  std::vector<BlockVector> next(blocks.size());
  const std::vector<BlockVector> zero = at.shift;
  std::vector<LinearizedMeasurement> last;
  for (;;) {
    for (std::size_t i = 0; i < blocks.size(); ++i)
      at.J[i] = chart_transition_jacobian(belief.chart(blocks[i]), at.prior[i], at.shift[i]);
    at.move_to(belief, at.shift);
    std::vector<LinearizedMeasurement> measurements = linearize_at(belief);
    for (std::size_t k = 0; k < measurements.size(); ++k)
      if (measurements[k].part_count > 0)
        at.express_at_prior(measurements[k]);
      else
        measurements[k] = last.at(k);
    at.move_to(belief, zero);
    const bool usable = belief.correction(measurements, blocks, next);
    report.converged = usable && at.largest_change(belief, next, settings) <= 1;
    if (!usable || report.converged || ++report.iterations >= settings.max_iterations) {
      report.update = belief.update(measurements);
      return report;
    }
    at.shift = next;
    last = std::move(measurements);
  }
}

}  // namespace incognita
