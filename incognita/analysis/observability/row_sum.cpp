#include "incognita/analysis/observability/row_sum.hpp"

#include <algorithm>

#include "incognita/belief/rank_update.hpp"

namespace incognita {

void RowSum::reserve(int size) {
  if (size <= capacity_) return;
  capacity_ = std::max(size, capacity_ + capacity_ / 2);
  int stride = round_up_to_panel(capacity_);
  if (stride % 512 == 0) stride += 8;  // avoids a power of two, with which columns share cache sets
  AlignedBuffer grown(static_cast<std::size_t>(stride) * static_cast<std::size_t>(capacity_ + 3));
  for (int j = 0; j < size_; ++j)
    std::copy_n(minus_.data() + static_cast<long>(j) * stride_, size_,
                grown.data() + static_cast<long>(j) * stride);
  minus_ = std::move(grown);
  stride_ = stride;
}

void RowSum::grow(int by) {
  reserve(size_ + by);
  for (int j = 0; j < size_ + by; ++j)
    std::fill_n(minus_.data() + static_cast<long>(j) * stride_ + size_, by, 0.0);
  size_ += by;
}

void RowSum::add(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  const auto rank = static_cast<int>(rows.rows());
  if (rank == 0 || size_ == 0) return;
  constexpr int panel = rank_update_panel;
  const std::size_t wanted =
      static_cast<std::size_t>(round_up_to_panel(size_)) * static_cast<std::size_t>(rank);
  if (packed_.size() < wanted) packed_ = AlignedBuffer(wanted);
  std::fill_n(packed_.data(), wanted, 0.0);
  for (int i = 0; i < size_; ++i)
    for (int k = 0; k < rank; ++k)
      packed_.data()[static_cast<long>(i / panel) * panel * rank + static_cast<long>(k) * panel + i % panel] =
          rows(k, i);
  rank_update(minus_.data(), stride_, size_, packed_.data(), rank);
}

void RowSum::subtract(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  lower().selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
}

Eigen::MatrixXd RowSum::rows(int first, int count) const {
  const int last = first + count, after = size_ - last;
  Eigen::MatrixXd out(count, size_);
  out.leftCols(first) = -lower().block(first, 0, count, first);
  const Eigen::MatrixXd own = lower().block(first, first, count, count).selfadjointView<Eigen::Lower>();
  out.middleCols(first, count) = -own;
  out.rightCols(after) = -lower().block(last, first, after, count).transpose();
  return out;
}

void RowSum::set_rows(int first, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  const auto count = static_cast<int>(rows.rows()), last = first + count, after = size_ - last;
  lower().block(first, 0, count, last) = -rows.leftCols(last);
  lower().block(last, first, after, count) = -rows.rightCols(after).transpose();
}

/// Of the lower triangle, what is below the removed rows moves to lower addresses: nothing is overwritten before it is copied.
void RowSum::remove(int first, int count) {
  const int last = first + count, left = size_ - count;
  for (int j = 0; j < left; ++j) {
    double* to = minus_.data() + static_cast<long>(j) * stride_;
    const double* from = minus_.data() + static_cast<long>(j < first ? j : j + count) * stride_;
    std::copy(from + last, from + size_, to + first);
  }
  size_ = left;
}

Eigen::MatrixXd RowSum::matrix() const {
  Eigen::MatrixXd full = lower().selfadjointView<Eigen::Lower>();
  return -full;
}

}  // namespace incognita
