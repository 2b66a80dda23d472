#include "incognita/slam/points/association.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "incognita/math/gaussian.hpp"

namespace incognita {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Chi-square gates for 1 to `most` degrees of freedom, by degrees of freedom.
std::vector<double> gates_up_to(int most, double probability) {
  std::vector<double> gates(most + 1, 0);
  for (int dof = 1; dof <= most; ++dof) gates[dof] = chi_square_quantile(probability, dof);
  return gates;
}

/// The joint search, one measurement per level. The Cholesky factor of the joint innovation covariance grows
/// and shrinks by one pairing at a time.
class BranchAndBound {
 public:
  BranchAndBound(const AnyBelief& belief, std::span<const Pairing> pairings, const std::vector<double>& alone,
                 const AssociationSettings& settings)
      : pairings_(pairings), settings_(settings) {
    collect(alone);
    std::vector<LinearizedMeasurement> measurements;
    first_row_.assign(pairings.size(), -1);
    int rows = 0;
    for (const auto& options : options_)
      for (const int p : options) {
        first_row_[p] = rows;
        rows += pairings[p].linearized.rows();
        measurements.push_back(pairings[p].linearized);
      }
    if (rows > 0) belief.innovation_covariance(measurements, S_);
    L_.setZero(rows, rows);
    whitened_.setZero(rows);
    gates_ = gates_up_to(rows, settings.probability);
  }

  Association run() {
    descend(0, 0, 0);
    return best_;
  }

 private:
  /// The individually compatible pairings by measurement, nearest first.
  void collect(const std::vector<double>& alone) {
    std::vector<int> order(pairings_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return pairings_[a].measurement != pairings_[b].measurement
                 ? pairings_[a].measurement < pairings_[b].measurement
                 : alone[a] < alone[b];
    });
    const std::vector<double> own_gates = gates_up_to(max_measurement_rows, settings_.probability);
    for (const int p : order) {
      if (!(alone[p] <= own_gates[pairings_[p].linearized.rows()])) continue;
      const int measurement = pairings_[p].measurement;
      if (options_.empty() || pairings_[options_.back().front()].measurement != measurement)
        options_.emplace_back();
      options_.back().push_back(p);
    }
  }

  bool taken(int landmark) const {
    return std::any_of(path_.begin(), path_.end(), [&](int p) { return pairings_[p].landmark == landmark; });
  }

  /// Appends a pairing to the path and updates `distance2`. Returns false, without effect, when the path
  /// would not be jointly compatible.
  bool push(int p, int rows, double& distance2) {
    const LinearizedMeasurement& linearized = pairings_[p].linearized;
    const int n = linearized.rows();
    Eigen::MatrixXd cross(n, rows);
    int column = 0;
    for (const int q : path_) {
      const int width = pairings_[q].linearized.rows();
      cross.middleCols(column, width) = S_.block(first_row_[p], first_row_[q], n, width);
      column += width;
    }
    auto known = L_.topLeftCorner(rows, rows).template triangularView<Eigen::Lower>();
    const Eigen::MatrixXd below = known.solve(cross.transpose()).transpose();
    const Eigen::MatrixXd own = S_.block(first_row_[p], first_row_[p], n, n) - below * below.transpose();
    const Eigen::LLT<Eigen::MatrixXd> llt(own);
    if (llt.info() != Eigen::Success) return false;
    const Eigen::VectorXd white = llt.matrixL().solve(linearized.residual - below * whitened_.head(rows));
    const double longer = distance2 + white.squaredNorm();
    if (!(longer <= gates_[rows + n])) return false;
    L_.block(rows, 0, n, rows) = below;
    L_.block(rows, rows, n, n) = llt.matrixL();
    whitened_.segment(rows, n) = white;
    path_.push_back(p);
    distance2 = longer;
    return true;
  }

  void descend(std::size_t measurement, int rows, double distance2) {
    if (best_.capped) return;
    if (++best_.nodes > settings_.max_nodes) {
      best_.capped = true;
      return;
    }
    if (path_.size() > best_.chosen.size() ||
        (path_.size() == best_.chosen.size() && distance2 < best_.distance2)) {
      best_.chosen = path_;
      best_.distance2 = distance2;
    }
    if (measurement == options_.size()) return;
    for (const int p : options_[measurement]) {
      if (!can_win(measurement + 1, 1, distance2)) return;
      double longer = distance2;
      if (taken(pairings_[p].landmark) || !push(p, rows, longer)) continue;
      descend(measurement + 1, rows + pairings_[p].linearized.rows(), longer);
      path_.pop_back();
    }
    if (can_win(measurement + 1, 0, distance2)) descend(measurement + 1, rows, distance2);
  }

  /// Whether the path with `more` pairings could beat the best one if all measurements from `next` on were paired.
  bool can_win(std::size_t next, std::size_t more, double distance2) const {
    const std::size_t most = path_.size() + more + (options_.size() - next);
    return most > best_.chosen.size() || (most == best_.chosen.size() && distance2 < best_.distance2);
  }

  std::span<const Pairing> pairings_;
  const AssociationSettings& settings_;
  std::vector<std::vector<int>> options_;  ///< pairings by measurement
  std::vector<int> first_row_;             ///< row of each pairing in S_
  std::vector<double> gates_;              ///< by degrees of freedom
  Eigen::MatrixXd S_;                      ///< joint innovation covariance of the compatible pairings
  Eigen::MatrixXd L_;                      ///< Cholesky factor of S_ restricted to the path
  Eigen::VectorXd whitened_;               ///< L^-1 r of the path
  std::vector<int> path_;
  Association best_;
};

}  // namespace

std::vector<double> individual_distances(const AnyBelief& belief, std::span<const Pairing> pairings) {
  std::vector<double> distances;
  Eigen::MatrixXd S;
  for (const Pairing& pairing : pairings) {
    belief.innovation_covariance({&pairing.linearized, 1}, S);
    const Eigen::LLT<Eigen::MatrixXd> llt(S);
    const double d2 = llt.info() == Eigen::Success
                          ? llt.matrixL().solve(Eigen::VectorXd(pairing.linearized.residual)).squaredNorm()
                          : never;
    distances.push_back(std::isfinite(d2) ? d2 : never);
  }
  return distances;
}

std::vector<int> nearest_first(std::span<const Candidate> candidates) {
  std::vector<int> order(candidates.size()), chosen;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return candidates[a].distance2 < candidates[b].distance2; });
  for (const int c : order) {
    const bool free = std::none_of(chosen.begin(), chosen.end(), [&](int other) {
      return candidates[other].measurement == candidates[c].measurement ||
             candidates[other].landmark == candidates[c].landmark;
    });
    if (free) chosen.push_back(c);
  }
  return chosen;
}

Association jointly_compatible(const AnyBelief& belief, std::span<const Pairing> pairings,
                               const AssociationSettings& settings) {
  return BranchAndBound(belief, pairings, individual_distances(belief, pairings), settings).run();
}

}  // namespace incognita
