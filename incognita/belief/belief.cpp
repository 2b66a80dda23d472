#include "incognita/belief/belief.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/belief/cholesky.hpp"
#include "incognita/belief/rank_update.hpp"
#include "incognita/belief/weighted_columns.hpp"

namespace incognita {

Belief::Belief(int expected_errors, MapCorrelations correlations) : correlations_(correlations) {
  reserve(std::max(expected_errors, 1));
}

BlockMatrix Belief::covariance(BlockId row, BlockId column) const {
  const Block &a = block(row), &b = block(column);
  BlockMatrix m(a.chart.tangent(), b.chart.tangent());
  for (int j = 0; j < m.cols(); ++j)
    for (int i = 0; i < m.rows(); ++i) m(i, j) = entry(a.error + i, b.error + j);
  return m;
}

Eigen::MatrixXd Belief::dense_covariance() const { return P().selfadjointView<Eigen::Lower>(); }

/// Calls set_column(column, values, count) for the elements from the diagonal down among the errors that keep their
/// order, and set(row, column, value) for those in the rows of the errors that are ordered last.
template <class SetColumn, class Set>
void Belief::copy_ordered(int first, int last, const SetColumn& set_column, const Set& set) const {
  const int kept = first + last, count = errors_ - kept;
  for (int j = 0; j < count; ++j) set_column(j, P_.column(kept + j) + kept + j, count - j);
  for (int i = 0; i < last; ++i) {
    for (int j = 0; j < count; ++j) set(count + i, j, entry(first + i, kept + j));
    for (int j = 0; j <= i; ++j) set(count + i, count + j, entry(first + i, first + j));
  }
}

void Belief::copy_covariance(int first, int last, double* out, int stride) const {
  const auto at = [&](int row, int column) { return out + row + static_cast<long>(column) * stride; };
  copy_ordered(
      first, last,
      [&](int column, const double* values, int count) { std::copy_n(values, count, at(column, column)); },
      [&](int row, int column, double value) { *at(row, column) = value; });
}

void Belief::copy_covariance(int first, int last, TiledCholesky& out) const {
  out.start(errors_ - first);
  copy_ordered(
      first, last,
      [&](int column, const double* values, int count) { out.set_column(column, column, values, count); },
      [&](int row, int column, double value) { out.set(row, column, value); });
}

void Belief::reserve(int errors) {
  if (!P_.reserve(errors, errors_)) return;
  delta_.resize(P_.capacity);
  const int rank = std::exchange(rank_capacity_, 0);
  if (rank > 0) reserve_rank(rank);
}

void Belief::reserve_rank(int rank) {
  if (rank <= rank_capacity_) return;
  rank_capacity_ = rank;
  PHt_ = AlignedBuffer(static_cast<std::size_t>(P_.stride) * rank);
  // W, followed by the workspace of whiten(); cholesky() uses the same storage before W exists
  packed_ = AlignedBuffer(std::max(static_cast<std::size_t>(P_.stride + round_up_to_panel(rank)) * rank,
                                   cholesky_workspace(rank)));
  S_stride_ = round_up_to_panel(rank) + rank_update_panel;
  S_ = AlignedBuffer(static_cast<std::size_t>(S_stride_) * rank);
  residual_.resize(rank);
  norms_.resize(std::max<Eigen::Index>(norms_.size(), rank));
}

BlockId Belief::add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                            const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  check_vehicle(chart, mean, covariance);
  if (vehicles_ == 1 && correlations_ == MapCorrelations::block_diagonal)
    throw std::logic_error("add_vehicle: a belief with a block-diagonal map has one vehicle at most");
  const int first = errors_;
  reserve(first + chart.tangent());
  const BlockId id = append_vehicle(chart, mean);
  P().bottomRows(chart.tangent()).leftCols(first).setZero();
  P().bottomRightCorner(chart.tangent(), chart.tangent()) = covariance;
  return id;
}

BlockId Belief::augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                        std::span<const Parent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  check_new_block(chart, mean, parents, noise);
  const int old = errors_, size = chart.tangent();
  reserve(old + size);
  const BlockId id = append(chart, mean);
  Matrix p = P();
  // Cross covariance with all existing blocks (2.24), then the block itself (2.25)
  for (int j = 0; j < old; ++j)
    for (int i = 0; i < size; ++i) {
      double sum = 0;
      for (const Parent& parent : parents) {
        const int from = block(parent.block).error;
        for (int k = 0; k < parent.J.cols(); ++k) sum += parent.J(i, k) * entry(from + k, j);
      }
      p(old + i, j) = sum;
    }
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) {
      double sum = 0.5 * (noise(i, j) + noise(j, i));
      for (const Parent& parent : parents) {
        const int from = block(parent.block).error;
        for (int k = 0; k < parent.J.cols(); ++k) sum += p(old + i, from + k) * parent.J(j, k);
      }
      p(old + i, old + j) = sum;
    }
  if (correlations_ == MapCorrelations::block_diagonal) separate_new_block(blocks_.back());
  if (trace_) trace_->emplace_back(BlockAugmentation{id, {parents.begin(), parents.end()}, noise});
  return id;
}

void Belief::replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                     const BlockMatrix& J, const BlockMatrix& noise) {
  check_replacement(id, chart, mean, J, noise);
  const int old_size = block(id).chart.tangent(), size = chart.tangent(), first = block(id).error;
  Matrix p = P();
  const BlockMatrix own = J * covariance(id) * J.transpose() + noise;
  BlockVector column(size);
  for (int j = 0; j < first; ++j) {  // left of the block
    column.noalias() = J * p.col(j).segment(first, old_size);
    p.col(j).segment(first, size) = column;
  }
  for (int i = first + old_size; i < errors_; ++i) {  // below it
    column.noalias() = J * p.row(i).segment(first, old_size).transpose();
    p.row(i).segment(first, size) = column.transpose();
  }
  p.block(first, first, size, size) = own;
  if (old_size > size) P_.remove(first + size, old_size - size, errors_);
  rechart(id, chart, mean);
  if (trace_) trace_->emplace_back(BlockReplacement{id, J, noise});
}

void Belief::drop(BlockId id) {
  P_.remove(block(id).error, block(id).chart.tangent(), errors_);
  forget(id);
  note(BlockDrop{id});
}

void Belief::predict(const LinearizedMotion& motion) {
  check(motion);
  const Block& b = block(motion.block);
  const int size = b.chart.tangent(), first = b.error, after = first + size;
  Matrix p = P();
  const BlockMatrix own = motion.A * covariance(motion.block) * motion.A.transpose() + motion.N;
  BlockVector column(size);
  for (int j = 0; j < first; ++j) {  // preceding vehicles
    column.noalias() = motion.A * p.col(j).segment(first, size);
    p.col(j).segment(first, size) = column;
  }
  // The rows below, in chunks that fit the L1 cache
  constexpr int chunk = 64;
  Eigen::Matrix<double, chunk, max_block_size> rows;
  for (int i = after; i < errors_; i += chunk) {
    const int count = std::min(chunk, errors_ - i);
    rows.topLeftCorner(count, size).setZero();
    for (int k = 0; k < size; ++k) {
      const BlockVector weights = motion.A.row(k);
      add_weighted_columns(rows.col(k).data(), &p(i, first), P_.stride, weights.data(), size, count);
    }
    p.block(i, first, count, size) = rows.topLeftCorner(count, size);
  }
  p.block(first, first, size, size) = 0.5 * (own + own.transpose());
  set_mean(motion.block, motion.x_next);
  note(motion);
}

void Belief::restore(BlockId id, const BlockVector& mean, const BlockMatrix& covariance,
                     std::size_t trace_size) {
  const Block& b = block(id);
  const int size = b.chart.tangent();
  if (covariance.rows() != size || covariance.cols() != size)
    throw std::invalid_argument("covariance of another size than the block: " +
                                std::to_string(covariance.rows()) + ", not " + std::to_string(size));
  set_mean(id, mean);
  P().block(b.error, b.error, size, size) = covariance;
  if (trace_ && trace_->size() > trace_size)
    trace_->erase(trace_->begin() + static_cast<std::ptrdiff_t>(trace_size), trace_->end());
}

}  // namespace incognita
