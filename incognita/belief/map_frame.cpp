// Operations on all blocks of the belief at once.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/belief/belief.hpp"
#include "incognita/belief/inflation.hpp"
#include "incognita/belief/weighted_columns.hpp"

namespace incognita {

namespace {

void refuse_frame_change(const std::string& why) { throw std::invalid_argument("carry: " + why); }

std::string square(int size) { return std::to_string(size) + "x" + std::to_string(size); }

}  // namespace

void Belief::change_frame(const LinearizedMotion& frame_motion, std::span<const MovedBlock> others) {
  if (correlations_ == MapCorrelations::block_diagonal)
    throw std::logic_error("change_frame: not available with a block-diagonal map");
  const int first = block(frame_motion.block).error, size = block(frame_motion.block).chart.tangent();
  if (frame_motion.A.rows() != size || frame_motion.A.cols() != size || frame_motion.N.rows() != size ||
      frame_motion.N.cols() != size || frame_motion.x_next.size() != chart(frame_motion.block).ambient())
    refuse_frame_change("A and N of the frame motion must be " + square(size) +
                        ", its mean as large as its chart");
  std::vector<BlockId> named{frame_motion.block};
  for (const MovedBlock& c : others) {
    const int own = block(c.block).chart.tangent();
    if (std::find(named.begin(), named.end(), c.block) != named.end())
      refuse_frame_change("block " + std::to_string(c.block) + " occurs twice");
    if (c.A.rows() != own || c.A.cols() != own || c.B.rows() != own || c.B.cols() != size ||
        c.x_next.size() != chart(c.block).ambient())
      refuse_frame_change("block " + std::to_string(c.block) + " needs A " + square(own) + ", B " +
                          std::to_string(own) + "x" + std::to_string(size) +
                          " and a mean as large as its chart");
    named.push_back(c.block);
  }
  // P <- T P T', T of diagonal blocks and the columns of the moving block: rows first, then columns
  Eigen::MatrixXd M = dense_covariance();
  const auto apply = [&](auto&& rows_of) {
    for (const MovedBlock& c : others) {
      auto rows = rows_of(block(c.block).error, block(c.block).chart.tangent());
      rows = (c.A * rows + c.B * rows_of(first, size)).eval();
    }
    auto rows = rows_of(first, size);
    rows = (frame_motion.A * rows).eval();
  };
  apply([&](int from, int count) { return M.middleRows(from, count); });
  M.transposeInPlace();
  apply([&](int from, int count) { return M.middleRows(from, count); });
  M.block(first, first, size, size) += frame_motion.N;
  P() = 0.5 * (M + M.transpose());
  for (const MovedBlock& c : others) set_mean(c.block, c.x_next);
  set_mean(frame_motion.block, frame_motion.x_next);
  note(CovarianceEdit::frame_changed);
}

void Belief::shear(BlockId vehicle, int first, std::span<const ErrorShear> landmarks) {
  if (correlations_ == MapCorrelations::block_diagonal)
    throw std::logic_error("shear: not available with a block-diagonal map");
  if (landmarks.empty()) return;
  const auto columns = static_cast<int>(landmarks.front().B.cols());
  const Block& v = block(vehicle);
  if (first < 0 || first + columns > v.chart.tangent())
    throw std::invalid_argument("shear: the vehicle has no errors " + std::to_string(first) + " to " +
                                std::to_string(first + columns - 1));
  for (const auto& [id, B] : landmarks)
    if (B.cols() != columns || B.rows() != block(id).chart.tangent() || block(id).error <= v.error)
      throw std::invalid_argument("shear: block " + std::to_string(id) + " must be a landmark and needs B " +
                                  std::to_string(block(id).chart.tangent()) + "x" + std::to_string(columns));
  // With E, which selects the errors of the vehicle: P + B M + M' B', M = E P + E P E' B' / 2
  reserve_rank(2 * columns);
  Matrix U(PHt_.data(), errors_, 2 * columns, Eigen::OuterStride<>(P_.stride));  // B, M'
  auto B = U.leftCols(columns), Mt = U.rightCols(columns);
  B.setZero();
  for (int k = 0; k < columns; ++k)
    for (int i = 0; i < errors_; ++i) Mt(i, k) = entry(i, v.error + first + k);
  const BlockMatrix half = 0.5 * covariance(vehicle).block(first, first, columns, columns);
  for (const auto& [id, of_landmark] : landmarks) {
    B.middleRows(block(id).error, of_landmark.rows()) += of_landmark;
    Mt.middleRows(block(id).error, of_landmark.rows()) += of_landmark * half;
  }
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * max_block_size, 1> weights(2 * columns);
  for (int j = 0; j < errors_; ++j) {
    weights << Mt.row(j).transpose(), B.row(j).transpose();
    add_weighted_columns(P_.column(j) + j, &U(j, 0), P_.stride, weights.data(), 2 * columns, errors_ - j);
  }
  note(BlockShear{vehicle, first, {landmarks.begin(), landmarks.end()}});
}

void Belief::decorrelate(Scope scope) {
  if (vehicles_ > 1) throw std::logic_error("decorrelate: only available with one vehicle");
  std::vector<int> sizes;
  for (const Block& b : blocks_) sizes.push_back(b.chart.tangent());
  if (sizes.size() < 2) return;
  // This may run at every step of a filter, so a low accuracy of the minimum suffices
  const InflationSettings settings{30, 1e-3};
  P() = scope == Scope::everything ? decorrelate_all(dense_covariance(), sizes, settings).P
                                   : decorrelate_map(dense_covariance(), sizes, settings).P;
  note(CovarianceEdit::decorrelated);
}

}  // namespace incognita
