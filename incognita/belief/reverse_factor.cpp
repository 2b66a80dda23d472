#include "incognita/belief/reverse_factor.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/belief/cholesky.hpp"
#include "incognita/belief/rounding.hpp"

namespace incognita {

void ReverseFactor::load(const Triangle& matrix, int size) {
  if (L_.reserve(size, 0)) workspace_ = AlignedBuffer(cholesky_workspace(L_.capacity));
  size_ = size;
  halves_.clear();
  constexpr int tile = 32;  // transposed by tiles that fit the L1 cache
  for (int from = 0; from < size; from += tile)
    for (int rows = from; rows < size; rows += tile)
      for (int j = from; j < std::min(from + tile, size); ++j) {
        const double* column = matrix.column(j);
        for (int i = std::max(rows, j); i < std::min(rows + tile, size); ++i)
          L_.column(size - 1 - i)[size - 1 - j] = column[i];
      }
}

bool ReverseFactor::factorize() {
  const Eigen::VectorXd before = L().diagonal();
  if (!cholesky(L_.storage.data(), L_.stride, size_, workspace_.data())) return false;
  for (int i = 0; i < size_; ++i)  // reject pivots that are rounding errors
    if (is_rounding(L()(i, i) * L()(i, i), before[i], size_)) return false;
  return true;
}

double ReverseFactor::log_det() const { return 2 * L().diagonal().array().log().sum(); }

double ReverseFactor::log_det_of_inverse(int first) const {
  return -2 * L().diagonal().tail(first).array().log().sum();
}

void ReverseFactor::solve(Eigen::Ref<Eigen::VectorXd> b) {
  b.reverseInPlace();
  L().triangularView<Eigen::Lower>().solveInPlace(b);
  L().triangularView<Eigen::Lower>().transpose().solveInPlace(b);
  b.reverseInPlace();
}

/// The columns of L^-1 for the errors [first, first + count), in reversed order.
const Eigen::MatrixXd& ReverseFactor::half(int first, int count) const {
  const auto [at, is_new] = halves_.try_emplace({first, count});
  if (is_new) {
    const int rows = first + count;
    at->second = Eigen::MatrixXd::Identity(rows, count);
    const auto last = L().bottomRightCorner(rows, rows);
    last.triangularView<Eigen::Lower>().solveInPlace(at->second);
  }
  return at->second;
}

Eigen::MatrixXd ReverseFactor::inverse(int row, int rows, int column, int columns) const {
  const Eigen::MatrixXd &a = half(row, rows), &b = half(column, columns);
  const Eigen::Index both = std::min(a.rows(), b.rows());
  return (a.bottomRows(both).transpose() * b.bottomRows(both)).reverse();
}

}  // namespace incognita
