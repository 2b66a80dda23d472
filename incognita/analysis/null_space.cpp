#include "incognita/analysis/null_space.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace incognita {
namespace {

/// Rows that are more than rounding, each of length one unless they are weighed already.
Eigen::MatrixXd unit_rows(const NoisyRows& M) {
  Eigen::MatrixXd kept(M.rows.rows(), M.rows.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < M.rows.rows(); ++i) {
    const double length = M.rows.row(i).stableNorm();
    if (length > M.noise[i]) kept.row(count++) = M.rows.row(i) / (M.weighed ? 1 : length);
  }
  return kept.topRows(count);
}

/// What brings every column to length one. A column whose entries are rounding beside rows of length one is
/// left as it is: it is nothing, and must not be made something.
Eigen::VectorXd scale_of_columns(const Eigen::MatrixXd& M, double nothing) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(M.cols());
  for (Eigen::Index j = 0; j < M.cols(); ++j) {
    const double length = M.col(j).stableNorm();
    if (length > nothing) scale[j] = 1 / length;
  }
  return scale;
}

/// An n x n matrix with the same null space and singular values: the triangle of a QR decomposition.
Eigen::MatrixXd triangle(const Eigen::MatrixXd& M) {
  const Eigen::Index n = M.cols();
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(n, n);
  if (M.rows() == 0) return R;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(M);
  const Eigen::Index rows = std::min(M.rows(), n);
  R.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  return R;
}

void decide(NullSpace& space, const NullSpaceSettings& settings) {
  const Eigen::VectorXd& s = space.singular_values;
  const Eigen::Index n = s.size();
  space.tolerance = settings.tolerance;
  const double least = n > 0 ? s[0] * settings.tolerance : 0;
  space.rank = n > 0 && s[0] > 0 ? static_cast<int>((s.array() > least).count()) : 0;
  space.nullity = static_cast<int>(n) - space.rank;
  const double left_out = space.nullity > 0 ? s[space.rank] : 0;
  // Below this part of the largest a singular value is rounding, however it compares with others like it
  const double rounding = n > 0 ? s[0] * 1e-13 : 0;
  space.gap =
      space.rank > 0 && left_out > 0 ? s[space.rank - 1] / left_out : std::numeric_limits<double>::infinity();
  space.ambiguous = left_out > rounding && space.gap < settings.clear_gap;
  // A value that just counts, or just does not, would be on the other side for another tolerance
  if (left_out > 0.03 * least || (space.rank > 0 && s[space.rank - 1] < 30 * least)) space.ambiguous = true;
}

}  // namespace

void NoisyRows::append(const Eigen::MatrixXd& more, const Eigen::VectorXd& their_noise) {
  if (more.rows() != their_noise.size()) throw std::invalid_argument("a row without its noise");
  const Eigen::Index before = rows.rows();
  rows.conservativeResize(before + more.rows(), more.cols());
  noise.conservativeResize(before + more.rows());
  rows.bottomRows(more.rows()) = more;
  noise.tail(more.rows()) = their_noise;
}

NullSpace null_space(const NoisyRows& M, const NullSpaceSettings& settings) {
  const Eigen::MatrixXd rows = unit_rows(M);
  NullSpace space;
  const Eigen::Index n = M.rows.cols();
  double largest = 0;
  for (Eigen::Index j = 0; j < rows.cols() && rows.rows() > 0; ++j)
    largest = std::max(largest, rows.col(j).stableNorm());
  space.column_scale = scale_of_columns(rows, 0.1 * settings.tolerance * largest);
  const Eigen::MatrixXd R = triangle(rows * space.column_scale.asDiagonal());
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeFullV);
  space.singular_values = svd.singularValues();
  space.scaled_right = svd.matrixV();
  decide(space, settings);
  space.scaled_null = space.scaled_right.rightCols(space.nullity);
  const Eigen::MatrixXd unscaled = space.column_scale.asDiagonal() * space.scaled_null;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(unscaled);
  space.basis = qr.householderQ() * Eigen::MatrixXd::Identity(n, space.nullity);
  return space;
}

double NullSpace::seen(const Eigen::VectorXd& direction) const {
  Eigen::VectorXd scaled = direction.cwiseQuotient(column_scale);
  const double length = scaled.norm();
  if (!(length > 0) || singular_values.size() == 0 || !(singular_values[0] > 0)) return 0;
  scaled = scaled_right.transpose() * (scaled / length);
  return singular_values.cwiseProduct(scaled).norm() / singular_values[0];
}

bool NullSpace::contains(const Eigen::VectorXd& direction) const {
  // Directions are told exactly; what the matrix makes of them is rounding and what the rank leaves out
  return direction.norm() > 0 && seen(direction) <= std::max(tolerance, 1e-12);
}

namespace {

/// Gauss-Jordan on the rows of B, pivots taken from the left where they are not small.
void reduce(Eigen::MatrixXd& B) {
  Eigen::Index row = 0;
  for (Eigen::Index column = 0; column < B.cols() && row < B.rows(); ++column) {
    Eigen::Index best = 0;
    const double size = B.col(column).tail(B.rows() - row).cwiseAbs().maxCoeff(&best);
    if (size < 1e-6) continue;
    B.row(row).swap(B.row(row + best));
    B.row(row) /= B(row, column);
    for (Eigen::Index other = 0; other < B.rows(); ++other)
      if (other != row) B.row(other) -= B(other, column) * B.row(row);
    ++row;
  }
}

/// The smallest multiple that makes every entry a whole number, where a small one does.
Eigen::VectorXd as_integers(const Eigen::VectorXd& v) {
  constexpr int largest_multiple = 12, largest_entry = 60;
  for (int multiple = 1; multiple <= largest_multiple; ++multiple) {
    const Eigen::VectorXd scaled = v * multiple, whole = scaled.array().round();
    if ((scaled - whole).cwiseAbs().maxCoeff() < 1e-7 && whole.cwiseAbs().maxCoeff() <= largest_entry)
      return whole;
  }
  return v;
}

}  // namespace

std::vector<Eigen::VectorXd> readable_basis(const Eigen::MatrixXd& basis) {
  Eigen::MatrixXd B = basis.transpose();
  reduce(B);
  std::vector<Eigen::VectorXd> vectors;
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    Eigen::VectorXd v = B.row(i);
    const double largest = v.cwiseAbs().maxCoeff();
    for (double& entry : v)
      if (std::abs(entry) < 1e-9 * largest) entry = 0;
    vectors.push_back(as_integers(v));
  }
  return vectors;
}

std::vector<bool> touched(const Eigen::MatrixXd& basis, double tolerance) {
  std::vector<bool> any(static_cast<std::size_t>(basis.rows()));
  for (Eigen::Index i = 0; i < basis.rows(); ++i)
    any[i] = basis.cols() > 0 && basis.row(i).norm() > tolerance;
  return any;
}

std::string written_combination(const Eigen::VectorXd& vector, const std::vector<std::string>& names) {
  std::string text;
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    if (vector[i] == 0) continue;
    const double size = std::abs(vector[i]);
    char number[32] = "";
    if (size != 1) std::snprintf(number, sizeof number, "%.4g ", size);
    text += text.empty() ? (vector[i] < 0 ? "-" : "") : (vector[i] < 0 ? " - " : " + ");
    text += number + names[static_cast<std::size_t>(i)];
  }
  return text.empty() ? "0" : text;
}

}  // namespace incognita
