#include "incognita/belief/cholesky.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace incognita {

bool cholesky(double* S, int stride, int n, double* workspace) {
  const auto at = [&](int i, int j) { return S + i + static_cast<long>(j) * stride; };
  for (int j = 0; j < n; ++j) std::fill(at(n, j), at(round_up_to_panel(n), j), 0.0);
  for (int first = 0; first < n; first += cholesky_block) {
    const int width = std::min(cholesky_block, n - first), next = first + width, left = n - next;
    Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> diagonal(at(first, first), width, width,
                                                                  Eigen::OuterStride<>(stride));
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(diagonal);
    if (llt.info() != Eigen::Success) return false;
    if (left == 0) break;
    whiten(at(next, first), stride, left, at(first, first), stride, width, workspace);
    for (int k = 0; k < width; ++k)
      for (int i = 0; i < left; ++i) *at(next + i, first + k) = workspace[panel_index(i, k, width)];
    rank_update(at(next, next), stride, left, workspace, width);
  }
  return true;
}

double log_determinant(const Eigen::MatrixXd& S) {
  const auto n = static_cast<int>(S.rows());
  const int stride = round_up_to_panel(n) + rank_update_panel;
  AlignedBuffer storage(static_cast<std::size_t>(stride) * n), workspace(cholesky_workspace(n));
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> L(storage.data(), n, n, Eigen::OuterStride<>(stride));
  L = S;
  if (!cholesky(storage.data(), stride, n, workspace.data())) return std::numeric_limits<double>::quiet_NaN();
  return 2 * L.diagonal().array().log().sum();
}

}  // namespace incognita
