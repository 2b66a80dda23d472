// The iterated update: an update linearised again where it leads, until it leads nowhere else. `belief` is
// one in either form: belief.hpp, information_belief.hpp, any_belief.hpp.
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
  double tolerance = 1e-8;      ///< largest change of an error of a block that is looked from or at
  double tolerance_sigmas = 0;  ///< or of that error by its prior standard deviation: what is less is settled
};

struct IterationReport {
  UpdateReport update;
  int iterations = 0;
  bool converged = false;  ///< else the cap was reached and the last linearisation used
};

/// d(y) / d(e) of x (+) (shift + e) = (x (+) shift) (+) y at e = 0: how an error that is told in the chart at
/// x is told in the chart where the shift leads. The identity where the chart is flat; of one with a
/// quaternion, whose right Jacobian it has, from differences, to 1e-10.
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

/// Where an iterated update started, and how far it has come: of each block that is looked from or at.
struct IteratedBlocks {
  std::vector<BlockId> ids;
  std::vector<BlockVector> prior, shift;
  std::vector<BlockMatrix> J;  ///< of `chart_transition_jacobian`

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

  /// z - h(x_i) - H_i (x_0 - x_i), and x_0 - x_i = -shift
  void express_at_prior(LinearizedMeasurement& measurement) const {
    for (int part = 0; part < measurement.part_count; ++part)
      for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] != measurement.parts[part].block) continue;
        measurement.parts[part].H = (measurement.parts[part].H * J[i]).eval();
        measurement.residual += measurement.parts[part].H * shift[i];
      }
  }

  /// By what is let pass.
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

/// Iterated update (Bell, Cathey 1993: Gauss-Newton on the posterior): linearises again where the update
/// would put the blocks that are looked from and at. `linearize_at(belief)` gives the looks linearised about the
/// belief's means, the same measurements in the same order each time; one without parts can not be had there,
/// and stays as it was linearised last. The covariance is that of the last linearisation.
///
/// The prior is told in the charts where it was made, and so is every step: a Jacobian by an error here is
/// taken back there.
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
