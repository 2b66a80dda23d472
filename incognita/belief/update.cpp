// The update in covariance form: all measurements at once, quadratic in the state, one pass over one triangle.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "incognita/belief/belief.hpp"
#include "incognita/belief/cholesky.hpp"
#include "incognita/belief/rank_update.hpp"
#include "incognita/belief/rounding.hpp"
#include "incognita/belief/weighted_columns.hpp"

namespace incognita {

/// H P, restricted to the columns of one block.
MeasurementJacobian Belief::times_covariance(const LinearizedMeasurement& measurement,
                                             const Block& to) const {
  MeasurementJacobian HP = MeasurementJacobian::Zero(measurement.rows(), to.chart.tangent());
  for (int part = 0; part < measurement.part_count; ++part) {
    const MeasurementJacobian& H = measurement.parts[part].H;
    const int from = block(measurement.parts[part].block).error;
    for (int j = 0; j < HP.cols(); ++j)
      for (int k = 0; k < H.cols(); ++k) {
        const double p = entry(from + k, to.error + j);
        for (int m = 0; m < H.rows(); ++m) HP(m, j) += H(m, k) * p;
      }
  }
  return HP;
}

template <class Destination>
void Belief::fill_innovation_covariance(std::span<const LinearizedMeasurement> measurements,
                                        Destination& S) const {
  int row = 0;
  for (std::size_t a = 0; a < measurements.size(); ++a) {
    // Nearly all measurements start with the measuring vehicle: its product is computed once
    BlockId vehicle = 0;
    MeasurementJacobian HP_vehicle;
    int column = 0;
    for (std::size_t b = 0; b <= a; ++b) {
      const LinearizedMeasurement& other = measurements[b];
      MeasurementMatrix sum = MeasurementMatrix::Zero(measurements[a].rows(), other.rows());
      if (a == b) sum = measurements[a].R;
      for (int part = 0; part < other.part_count; ++part) {
        const BlockId id = other.parts[part].block;
        const bool known = part == 0 && b > 0 && id == vehicle;
        const MeasurementJacobian HP = known ? HP_vehicle : times_covariance(measurements[a], block(id));
        sum += HP.lazyProduct(other.parts[part].H.transpose());
        if (part == 0 && !known) vehicle = id, HP_vehicle = HP;
      }
      S.block(row, column, sum.rows(), sum.cols()) = sum;
      if (a != b) S.block(column, row, sum.cols(), sum.rows()) = sum.transpose();
      column += other.rows();
    }
    row += measurements[a].rows();
  }
}

void Belief::innovation_covariance(std::span<const LinearizedMeasurement> measurements,
                                   Eigen::MatrixXd& S) const {
  const int rows = check(measurements);
  S.resize(rows, rows);
  fill_innovation_covariance(measurements, S);
}

/// out[r, m] += H[m, :] * P[block, r] for the errors r of [first, last) up to the block's end. There the
/// lower triangle stores P[block, r] contiguously, in column r.
void Belief::gather_above(const MeasurementJacobian& H, const Block& b, int first, int last,
                          double* out) const {
  const int size = b.chart.tangent(), rows = static_cast<int>(H.rows());
  const auto add = [&](int r, const double* p) {
    for (int m = 0; m < rows; ++m) {
      double sum = 0;
      for (int k = 0; k < size; ++k) sum += H(m, k) * p[k];
      out[r + static_cast<long>(m) * P_.stride] += sum;
    }
  };
  for (int r = first; r < std::min(last, b.error); ++r) add(r, P_.column(r) + b.error);
  for (int r = std::max(first, b.error); r < std::min(last, b.error + size); ++r) {
    double p[max_block_size];
    for (int k = 0; k < size; ++k) p[k] = entry(r, b.error + k);
    add(r, p);
  }
}

/// The same for the errors [first, last) below the block, stored along the block's columns.
void Belief::gather_below(const MeasurementJacobian& H, const Block& b, int first, int last,
                          double* out) const {
  const int size = b.chart.tangent(), from = std::max(first, b.error + size);
  if (from >= last) return;
  const double* P_from = P_.column(b.error) + from;
  for (int m = 0; m < H.rows(); ++m) {
    const BlockVector weights = H.row(m);
    add_weighted_columns(out + from + static_cast<long>(m) * P_.stride, P_from, P_.stride, weights.data(),
                         size, last - from);
  }
}

/// P H', errors x rows, by chunks of errors that stay in the caches.
void Belief::gather_PHt(std::span<const LinearizedMeasurement> measurements, int rank) {
  for (int m = 0; m < rank; ++m)
    std::fill_n(PHt_.data() + static_cast<long>(m) * P_.stride, round_up_to_panel(errors_), 0.0);
  const auto for_each_part = [&](const auto& work) {
    double* out = PHt_.data();
    for (const LinearizedMeasurement& measurement : measurements) {
      for (int i = 0; i < measurement.part_count; ++i)
        work(measurement.parts[i].H, block(measurement.parts[i].block), out);
      out += static_cast<long>(measurement.rows()) * P_.stride;
    }
  };
  constexpr int chunk = 64;
  for (int i = 0; i < errors_; i += chunk) {
    const int end = std::min(i + chunk, errors_);
    for_each_part(
        [&](const MeasurementJacobian& H, const Block& b, double* out) { gather_above(H, b, i, end, out); });
    for_each_part(
        [&](const MeasurementJacobian& H, const Block& b, double* out) { gather_below(H, b, i, end, out); });
  }
}

/// fill_innovation_covariance() from P H' (lower triangle only): the columns of one measurement stay in the
/// L1 cache while all others read them.
void Belief::innovation_from_PHt(std::span<const LinearizedMeasurement> measurements) {
  int column = 0;
  for (std::size_t a = 0; a < measurements.size(); ++a) {
    const int columns = measurements[a].rows();
    int row = column;
    for (std::size_t b = a; b < measurements.size(); row += measurements[b++].rows())
      for (int m = 0; m < columns; ++m) {
        const double* PHt = PHt_.data() + static_cast<long>(column + m) * P_.stride;
        double* out = S_.data() + row + static_cast<long>(column + m) * S_stride_;
        for (int i = 0; i < measurements[b].rows(); ++i) out[i] = a == b ? measurements[a].R(i, m) : 0;
        for (int part = 0; part < measurements[b].part_count; ++part) {
          const MeasurementJacobian& H = measurements[b].parts[part].H;
          const double* of_block = PHt + block(measurements[b].parts[part].block).error;
          for (int k = 0; k < H.cols(); ++k)
            for (int i = 0; i < H.rows(); ++i) out[i] += H(i, k) * of_block[k];
        }
      }
    column += columns;
  }
}

bool Belief::factorize_innovation(std::span<const LinearizedMeasurement> measurements, UpdateReport& report) {
  report.rows = check(measurements);
  reserve_rank(report.rows);
  auto filled = S(report.rows);
  fill_innovation_covariance(measurements, filled);
  return factorize_filled(measurements, report);
}

/// S_ <- L with S = L L', residual_ <- L^-1 residual; fills NIS and log-determinants of the report. False
/// when S is not positive definite within rounding.
bool Belief::factorize_filled(std::span<const LinearizedMeasurement> measurements, UpdateReport& report) {
  int row = 0;
  for (const LinearizedMeasurement& measurement : measurements) {
    residual_.segment(row, measurement.rows()) = measurement.residual;
    row += measurement.rows();
    const Eigen::LLT<MeasurementMatrix> R(measurement.R);
    if (R.info() != Eigen::Success) return false;
    for (int i = 0; i < measurement.rows(); ++i) report.log_det_R += 2 * std::log(R.matrixLLT()(i, i));
  }
  if (!cholesky(S_.data(), S_stride_, report.rows, packed_.data())) return false;
  const auto L = S(report.rows);
  if (!residual_.head(report.rows).allFinite()) return false;
  auto norms = norms_.head(report.rows);
  norms.setZero();
  for (int k = 0; k < report.rows; ++k) {
    norms.tail(report.rows - k) += L.col(k).tail(report.rows - k).cwiseAbs2();
    // A pivot within rounding of its row's norm is noise
    if (is_rounding(L(k, k) * L(k, k), norms[k], report.rows)) return false;
    residual_[k] /= L(k, k);  // forward substitution
    residual_.segment(k + 1, report.rows - k - 1) -= residual_[k] * L.col(k).tail(report.rows - k - 1);
  }
  report.log_det_S = 2 * L.diagonal().array().log().sum();
  if (!std::isfinite(report.log_det_S)) return false;
  report.nis = residual_.head(report.rows).squaredNorm();
  return true;
}

/// delta = K * residual = W * (L^-1 residual). False when a posterior variance would be lost to rounding
/// because P is too much larger than R.
bool Belief::compute_delta(int rank) {
  constexpr int lanes = rank_update_panel;
  for (int first = 0; first < errors_; first += lanes) {
    const double* w = packed_.data() + panel_index(first, 0, rank);
    double sum[lanes] = {}, taken[lanes] = {};
    for (int k = 0; k < rank; ++k, w += lanes)
      for (int i = 0; i < lanes; ++i) {
        sum[i] += w[i] * residual_[k];
        taken[i] += w[i] * w[i];
      }
    for (int i = 0; i < std::min(lanes, errors_ - first); ++i) {
      const double variance = entry(first + i, first + i);
      if (taken[i] > 0 && is_rounding(variance - taken[i], variance, rank)) return false;
      delta_[first + i] = sum[i];
    }
  }
  return true;
}

bool Belief::correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                        std::span<BlockVector> out) {
  if (correlations_ == MapCorrelations::block_diagonal)
    throw std::logic_error(
        "correction: not available with a block-diagonal map, where measurements are applied sequentially");
  UpdateReport report;
  if (measurements.empty() || !factorize_innovation(measurements, report)) return false;
  auto y = residual_.head(report.rows);  // S^-1 residual
  S(report.rows).triangularView<Eigen::Lower>().transpose().solveInPlace(y);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    out[i] = BlockVector::Zero(block(blocks[i]).chart.tangent());
    int row = 0;
    for (const LinearizedMeasurement& measurement : measurements) {
      const MeasurementVector of_measurement = y.segment(row, measurement.rows());
      for (int part = 0; part < measurement.part_count; ++part) {
        const BlockVector weighted = measurement.parts[part].H.transpose().lazyProduct(of_measurement);
        out[i] += covariance(blocks[i], measurement.parts[part].block).lazyProduct(weighted);
      }
      row += measurement.rows();
    }
  }
  return true;
}

UpdateReport Belief::update(std::span<const LinearizedMeasurement> measurements) {
  if (correlations_ == MapCorrelations::block_diagonal) return update_block_diagonal(measurements);
  UpdateReport report;
  if (measurements.empty()) return report;
  report.rows = check(measurements);
  reserve_rank(report.rows);
  gather_PHt(measurements, report.rows);
  innovation_from_PHt(measurements);
  if (!factorize_filled(measurements, report)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  // W = P H' L^-T
  whiten(PHt_.data(), P_.stride, errors_, S_.data(), S_stride_, report.rows, packed_.data());
  if (!compute_delta(report.rows)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  rank_update(P_.column(0), P_.stride, errors_, packed_.data(), report.rows);
  shift_mean({delta_.data(), static_cast<std::size_t>(errors_)});
  report.outcome = UpdateReport::Outcome::updated;
  note(measurements);
  return report;
}

}  // namespace incognita
