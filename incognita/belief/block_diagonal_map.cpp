// Updates that keep the map block diagonal, in time linear in the map: thesis Section 3.3.
//
// A measurement update is P - W W'. It is exact for the vehicle and the cross covariances. For the map part, D - W_f
// W_f' with D block diagonal, only a block-diagonal upper bound is kept. For one column w of W_f with blocks w_i,
//
//   w w' >= blockdiag(t_i w_i w_i')   if and only if   |sum u_i|^2 >= sum t_i u_i^2 for all numbers u_i,
//
// so at most one t_i is positive. The bound of least trace shrinks the block with the longest w_i, if it is
// longer than the sum A of all others: t = c / |w_i| with c = |w_i| - A, and the others are inflated, t_j =
// -c / |w_j|; the trace falls by c^2. Otherwise no bound improves on the unchanged map.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "incognita/belief/belief.hpp"
#include "incognita/belief/rank_update.hpp"
#include "incognita/belief/rounding.hpp"

namespace incognita {
namespace {

/// (M M')^1/2 of a small matrix.
BlockMatrix absolute(const BlockMatrix& M) {
  const Eigen::JacobiSVD<BlockMatrix> svd(M, Eigen::ComputeThinU);
  return svd.matrixU() * svd.singularValues().asDiagonal() * svd.matrixU().transpose();
}

/// Element of W in the panel layout of rank_update.
double& panel_entry(double* packed, int rank, int row, int column) {
  return packed[panel_index(row, column, rank)];
}

}  // namespace

UpdateReport Belief::update_block_diagonal(std::span<const LinearizedMeasurement> measurements) {
  UpdateReport report;
  if (measurements.empty()) return report;
  if (!factorize_innovation(measurements, report)) {  // joint NIS and log-determinants, about the prior
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  delta_.head(errors_).setZero();
  const std::span<double> delta(delta_.data(), static_cast<std::size_t>(errors_));
  report.outcome = UpdateReport::Outcome::nothing;
  for (const LinearizedMeasurement& measurement : measurements) {
    if (!apply_measurement(measurement, delta)) continue;
    report.outcome = UpdateReport::Outcome::updated;
    note(measurement);
  }
  note(CovarianceEdit::decorrelated);
  if (report.outcome == UpdateReport::Outcome::nothing) report.outcome = UpdateReport::Outcome::singular;
  shift_mean(delta);
  return report;
}

/// Applies one measurement. `delta`: correction by the previous ones, about the same means.
bool Belief::apply_measurement(const LinearizedMeasurement& measurement, std::span<double> delta) {
  LinearizedMeasurement left = measurement;
  for (int i = 0; i < measurement.part_count; ++i) {
    const Block& b = block(measurement.parts[i].block);
    left.residual -=
        measurement.parts[i].H * Eigen::Map<const Eigen::VectorXd>(delta.data() + b.error, b.chart.tangent());
  }
  UpdateReport report;
  const std::span<const LinearizedMeasurement> one(&left, 1);
  if (!factorize_innovation(one, report)) return false;
  gather_PHt(one, report.rows);
  whiten(PHt_.data(), P_.stride, errors_, S_.data(), S_stride_, report.rows, packed_.data());
  if (!leaves_variances(report.rows)) return false;
  align_columns(left);
  for (int i = 0; i < errors_; ++i)
    for (int k = 0; k < report.rows; ++k)
      delta[i] += panel_entry(packed_.data(), report.rows, i, k) * residual_[k];
  shrink_arrow(report.rows);
  for (int k = 0; k < report.rows; ++k) shrink_map(report.rows, k);
  return true;
}

/// The rounding check of update(): no posterior variance may be lost to cancellation.
bool Belief::leaves_variances(int rank) {
  for (int i = 0; i < errors_; ++i) {
    double taken = 0;
    for (int k = 0; k < rank; ++k) taken += std::pow(panel_entry(packed_.data(), rank, i, k), 2);
    if (taken > 0 && is_rounding(entry(i, i) - taken, entry(i, i), rank)) return false;
  }
  return true;
}

/// W W' is invariant under W U with U orthogonal, but the bound per column is not. The columns are rotated to
/// the principal axes of the measurement's effect on its landmark.
void Belief::align_columns(const LinearizedMeasurement& measurement) {
  const int rank = measurement.rows();
  if (measurement.part_count < 2 || rank < 2) return;
  const Block& landmark_block = block(measurement.parts[measurement.part_count - 1].block);
  MeasurementMatrix own = MeasurementMatrix::Zero(rank, rank);
  for (int i = landmark_block.error; i < landmark_block.error + landmark_block.chart.tangent(); ++i)
    for (int a = 0; a < rank; ++a)
      for (int b = 0; b < rank; ++b)
        own(a, b) += panel_entry(packed_.data(), rank, i, a) * panel_entry(packed_.data(), rank, i, b);
  const Eigen::SelfAdjointEigenSolver<MeasurementMatrix> eigen(own);
  const MeasurementMatrix& U = eigen.eigenvectors();
  MeasurementVector row(rank);
  for (int i = 0; i < errors_; ++i) {
    for (int k = 0; k < rank; ++k) row[k] = panel_entry(packed_.data(), rank, i, k);
    row = (U.transpose() * row).eval();
    for (int k = 0; k < rank; ++k) panel_entry(packed_.data(), rank, i, k) = row[k];
  }
  residual_.head(rank) = (U.transpose() * residual_.head(rank)).eval();
}

/// P - W W' in the columns of the vehicle.
void Belief::shrink_arrow(int rank) {
  const Block& vehicle = blocks_.front();
  Matrix p = P();
  for (int j = vehicle.error; j < vehicle.error + vehicle.chart.tangent(); ++j)
    for (int k = 0; k < rank; ++k) {
      const double w = panel_entry(packed_.data(), rank, j, k);
      for (int i = j; i < errors_; ++i) p(i, j) -= panel_entry(packed_.data(), rank, i, k) * w;
    }
}

/// The bound of the diagonal map blocks for one column of W.
void Belief::shrink_map(int rank, int column) {
  const std::size_t count = blocks_.size();
  if (static_cast<std::size_t>(norms_.size()) < count) norms_.resize(static_cast<Eigen::Index>(2 * count));
  const auto w = [&](int i) { return panel_entry(packed_.data(), rank, i, column); };
  double sum = 0, longest = 0;
  std::size_t at = 0;
  for (std::size_t b = vehicles_; b < count; ++b) {
    double square = 0;
    for (int i = 0; i < blocks_[b].chart.tangent(); ++i) square += std::pow(w(blocks_[b].error + i), 2);
    norms_[static_cast<Eigen::Index>(b)] = std::sqrt(square);
    sum += norms_[static_cast<Eigen::Index>(b)];
    if (norms_[static_cast<Eigen::Index>(b)] <= longest) continue;
    longest = norms_[static_cast<Eigen::Index>(b)];
    at = b;
  }
  const double c = 2 * longest - sum;  // |w_i| - A
  if (!(c > 0)) return;
  Matrix p = P();
  for (std::size_t b = vehicles_; b < count; ++b) {
    const double norm = norms_[static_cast<Eigen::Index>(b)];
    if (!(norm > 0)) continue;
    const double t = b == at ? -c / longest : c / norm;
    const int first = blocks_[b].error, end = first + blocks_[b].chart.tangent();
    for (int j = first; j < end; ++j)
      for (int i = j; i < end; ++i) p(i, j) += t * w(i) * w(j);
  }
}

/// A new landmark is correlated with all others through the vehicle. A cross covariance C of two blocks is
/// removed by adding [C C']^1/2 and [C' C]^1/2 to them, the least possible trace.
void Belief::separate_new_block(const Block& new_block) {
  Matrix p = P();
  const int size = new_block.chart.tangent();
  BlockMatrix own = BlockMatrix::Zero(size, size);
  for (std::size_t i = vehicles_; i + 1 < blocks_.size(); ++i) {
    const Block& b = blocks_[i];
    const int other = b.chart.tangent();
    const BlockMatrix C = p.block(new_block.error, b.error, size, other);
    own += absolute(C);
    p.block(b.error, b.error, other, other) += absolute(C.transpose());
    p.block(new_block.error, b.error, size, other).setZero();
  }
  p.block(new_block.error, new_block.error, size, size) += own;
}

}  // namespace incognita
