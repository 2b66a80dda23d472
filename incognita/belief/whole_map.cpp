// What changes every block of the belief at once.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/belief/inflation.hpp"

namespace incognita {

namespace {

void refuse_carry(const std::string& why) { throw std::invalid_argument("carry: " + why); }

std::string square(int size) { return std::to_string(size) + "x" + std::to_string(size); }

}  // namespace

void Belief::carry(const AffineMotion& mover, std::span<const Carried> others) {
  if (correlations_ == MapCorrelations::dropped)
    throw std::logic_error("carry: a map whose correlations are dropped cannot move as a whole");
  const int first = block(mover.block).error, size = block(mover.block).chart.tangent();
  if (mover.A.rows() != size || mover.A.cols() != size || mover.N.rows() != size || mover.N.cols() != size ||
      mover.x_next.size() != chart(mover.block).ambient())
    refuse_carry("A and N of the mover must be " + square(size) + ", its mean as long as its chart's");
  std::vector<BlockId> named{mover.block};
  for (const Carried& c : others) {
    const int own = block(c.block).chart.tangent();
    if (std::find(named.begin(), named.end(), c.block) != named.end())
      refuse_carry("block " + std::to_string(c.block) + " is named twice");
    if (c.A.rows() != own || c.A.cols() != own || c.B.rows() != own || c.B.cols() != size ||
        c.x_next.size() != chart(c.block).ambient())
      refuse_carry("block " + std::to_string(c.block) + " needs A " + square(own) + ", B " +
                   std::to_string(own) + "x" + std::to_string(size) + " and a mean as long as its chart's");
    named.push_back(c.block);
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
  note(Reshaping::carried);
}

void Belief::decorrelate(Scope scope) {
  if (vehicles_ > 1) throw std::logic_error("decorrelate: one vehicle, not more");
  std::vector<int> sizes;
  for (const Block& b : blocks_) sizes.push_back(b.chart.tangent());
  if (sizes.size() < 2) return;
  // A filter does this at every step: what is added need not be the least to its last digit
  const InflationSettings settings{30, 1e-3};
  P() = scope == Scope::everything ? decorrelate_all(dense_covariance(), sizes, settings).P
                                   : decorrelate_map(dense_covariance(), sizes, settings).P;
  note(Reshaping::decorrelated);
}

}  // namespace incognita
