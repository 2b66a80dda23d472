#include "incognita/belief/tiled_cholesky.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {
namespace {

constexpr int n = TiledCholesky::tile;
using Tile = Eigen::Map<Eigen::Matrix<double, n, n>>;
using ConstTile = Eigen::Map<const Eigen::Matrix<double, n, n>>;

}  // namespace

void TiledCholesky::start(int size) {
  size_ = size;
  tiles_ = (size + n - 1) / n;
  for (int row = static_cast<int>(rows_.size()); row < tiles_; ++row)
    rows_.emplace_back(static_cast<std::size_t>(row + 1) * n * n);
  row_ = column_ = term_ = 0;
  positive_ = size;
  if (size % n == 0) return;
  // The last tiles reach beyond the matrix: it is continued by the identity
  double* last = rows_[static_cast<std::size_t>(tiles_ - 1)].data();
  std::fill_n(last, static_cast<long>(tiles_) * n * n, 0.0);
  for (int i = size % n; i < n; ++i) at(tiles_ - 1, tiles_ - 1)[i + i * n] = 1;
}

void TiledCholesky::set_column(int column, int first, const double* values, int count) {
  for (int row = first; row < first + count;) {
    const int end = std::min((row / n + 1) * n, first + count);
    std::copy_n(values + (row - first), end - row, at(row / n, column / n) + row % n + (column % n) * n);
    row = end;
  }
}

void TiledCholesky::set(int row, int column, double value) {
  at(row / n, column / n)[row % n + (column % n) * n] = value;
}

bool TiledCholesky::advance(long steps) {
  for (; steps > 0 && !is_done(); --steps) step();
  return is_done();
}

/// Row by row of tiles, L_ij = (P_ij - sum over k < j of L_ik L_jk') L_jj^-T, and L_ii L_ii' = P_ii - sum L_ik L_ik'.
void TiledCholesky::step() {
  Tile own(at(row_, column_));
  if (term_ < column_) {
    own.noalias() -= ConstTile(at(row_, term_)) * ConstTile(at(column_, term_)).transpose();
    ++term_;
    return;
  }
  term_ = 0;
  if (column_ < row_) {
    const ConstTile diagonal(at(column_, column_));
    diagonal.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(own);
    ++column_;
    return;
  }
  if (!factorize_diagonal(row_)) {
    row_ = tiles_;
    return;
  }
  ++row_;
  column_ = 0;
}

bool TiledCholesky::factorize_diagonal(int row) {
  Eigen::Ref<Eigen::MatrixXd> own = Tile(at(row, row));
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(own);
  if (llt.info() == Eigen::Success) return true;
  positive_ = row * n;
  return false;
}

double TiledCholesky::log_det(int rows) const {
  if (rows > positive_) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (int i = 0; i < rows; ++i) sum += std::log(at(i / n, i / n)[i % n + (i % n) * n]);
  return 2 * sum;
}

long TiledCholesky::steps_of(int size) {
  const long tiles = (size + n - 1) / n;
  return tiles * (tiles + 1) * (tiles + 2) / 6;
}

}  // namespace incognita
