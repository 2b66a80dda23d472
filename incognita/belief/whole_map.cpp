// What changes every block of the belief at once.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/belief/inflation.hpp"

namespace incognita {

void Belief::carry(const AffineMotion& mover, std::span<const Carried> others) {
  const int first = block(mover.block).error, size = block(mover.block).chart.tangent();
  if (mover.A.rows() != size || mover.A.cols() != size || mover.N.rows() != size || mover.N.cols() != size)
    throw std::invalid_argument("carry: A and N of the mover must be " + std::to_string(size) + "x" +
                                std::to_string(size));
  for (const Carried& c : others) {
    const int own = block(c.block).chart.tangent();
    if (c.block == mover.block || c.A.rows() != own || c.A.cols() != own || c.B.rows() != own ||
        c.B.cols() != size)
      throw std::invalid_argument("carry: block " + std::to_string(c.block) + " needs A " +
                                  std::to_string(own) + "x" + std::to_string(own) + " and B " +
                                  std::to_string(own) + "x" + std::to_string(size));
  }
  // P <- T P T', T of diagonal blocks and the mover's columns: rows first, then columns
  Eigen::MatrixXd M = dense_covariance();
  const auto apply = [&](auto&& rows_of) {
    for (const Carried& c : others) {
      auto rows = rows_of(block(c.block).error, block(c.block).chart.tangent());
      rows = (c.A * rows + c.B * rows_of(first, size)).eval();
    }
    auto rows = rows_of(first, size);
    rows = (mover.A * rows).eval();
  };
  apply([&](int from, int count) { return M.middleRows(from, count); });
  M.transposeInPlace();
  apply([&](int from, int count) { return M.middleRows(from, count); });
  M.block(first, first, size, size) += mover.N;
  P() = 0.5 * (M + M.transpose());
  for (const Carried& c : others) set_mean(c.block, c.x_next);
  set_mean(mover.block, mover.x_next);
}

void Belief::decorrelate(Scope scope) {
  std::vector<int> sizes;
  for (const Block& b : blocks_) sizes.push_back(b.chart.tangent());
  if (sizes.size() < 2) return;
  // A filter does this at every step: what is added need not be the least to its last digit
  const InflationSettings settings{30, 1e-3};
  P() = scope == Scope::everything ? decorrelate_all(dense_covariance(), sizes, settings).P
                                   : decorrelate_map(dense_covariance(), sizes, settings).P;
}

}  // namespace incognita
