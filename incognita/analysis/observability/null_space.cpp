#include "incognita/analysis/observability/null_space.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace incognita {
namespace {

/// Rows with entries at rounding level set to 0, normalized unless weighed; zero rows are removed.
Eigen::MatrixXd unit_rows(const NoisyRows& M) {
  Eigen::MatrixXd kept(M.rows.rows(), M.rows.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < M.rows.rows(); ++i) {
    const auto counts = M.rows.row(i).array().abs() > M.noise.row(i).array();
    const Eigen::RowVectorXd row = counts.select(M.rows.row(i).array(), 0.0);
    const double length = row.stableNorm();
    if (length > 0) kept.row(count++) = row / (M.weighed ? 1 : length);
  }
  return kept.topRows(count);
}

/// Columns without remaining entries whose values exceeded common rounding.
std::vector<bool> faint_columns(const NoisyRows& M, const Eigen::MatrixXd& kept) {
  std::vector<bool> faint(static_cast<std::size_t>(M.rows.cols()));
  for (Eigen::Index j = 0; j < M.rows.cols(); ++j) {
    if (kept.rows() > 0 && kept.col(j).cwiseAbs().maxCoeff() > 0) continue;
    const auto at = static_cast<std::size_t>(j);
    faint[at] = at < M.faint.size() && M.faint[at];
    // The noise bounds are generous
    for (Eigen::Index i = 0; i < M.rows.rows() && !faint[at]; ++i)
      faint[at] = std::abs(M.rows(i, j)) > 1e-5 * M.noise(i, j);
  }
  return faint;
}

/// Factors that scale every column to length one.
Eigen::VectorXd scale_of_columns(const Eigen::MatrixXd& M) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(M.cols());
  for (Eigen::Index j = 0; j < M.cols(); ++j) {
    const double length = M.col(j).stableNorm();
    if (length > 0) scale[j] = 1 / length;
  }
  return scale;
}

/// n x n matrix with the same null space and singular values: R of a QR decomposition.
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
  // Singular values below this fraction of the largest are rounding, whatever the gap among them
  const double rounding = n > 0 ? s[0] * 1e-13 : 0;
  space.least = space.rank > 0 ? s[space.rank - 1] / s[0] : 0;
  space.gap =
      space.rank > 0 && left_out > 0 ? s[space.rank - 1] / left_out : std::numeric_limits<double>::infinity();
  space.ambiguous = left_out > rounding && space.gap < settings.clear_gap;
  // A value near the threshold would be counted differently under another tolerance
  if (left_out > 0.03 * least || (space.rank > 0 && s[space.rank - 1] < 30 * least)) space.ambiguous = true;
}

}  // namespace

NoisyRows NoisyRows::exact(const Eigen::MatrixXd& rows) {
  return {rows, Eigen::MatrixXd::Zero(rows.rows(), rows.cols()), false, {}};
}

void NoisyRows::append(const NoisyRows& more) {
  if (more.rows.rows() != more.noise.rows() || more.rows.cols() != more.noise.cols())
    throw std::invalid_argument("NoisyRows: rows and noise must have the same size");
  const Eigen::Index before = rows.rows(), after = before + more.rows.rows(), n = more.rows.cols();
  rows.conservativeResize(after, n);
  noise.conservativeResize(after, n);
  rows.bottomRows(after - before) = more.rows;
  noise.bottomRows(after - before) = more.noise;
  faint.resize(std::max(faint.size(), more.faint.size()));
  for (std::size_t j = 0; j < more.faint.size(); ++j) faint[j] = faint[j] || more.faint[j];
}

NoisyRows NoisyRows::condensed() const {
  const Eigen::MatrixXd kept = unit_rows(*this);
  NoisyRows all = exact(kept.rows() > kept.cols() ? triangle(kept) : kept);
  all.weighed = true;
  all.faint = faint_columns(*this, kept);
  return all;
}

NullSpace null_space(const NoisyRows& M, const NullSpaceSettings& settings) {
  const Eigen::MatrixXd rows = unit_rows(M);
  NullSpace space;
  const Eigen::Index n = M.rows.cols();
  space.column_scale = scale_of_columns(rows);
  const Eigen::MatrixXd R = triangle(rows * space.column_scale.asDiagonal());
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeFullV);
  space.singular_values = svd.singularValues();
  space.scaled_right = svd.matrixV();
  decide(space, settings);
  space.faint = faint_columns(M, rows);
  if (std::find(space.faint.begin(), space.faint.end(), true) != space.faint.end()) space.ambiguous = true;
  space.scaled_null = space.scaled_right.rightCols(space.nullity);
  const Eigen::MatrixXd unscaled = space.column_scale.asDiagonal() * space.scaled_null;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(unscaled);
  space.basis = qr.householderQ() * Eigen::MatrixXd::Identity(n, space.nullity);
  return space;
}

double NullSpace::observed_share(const Eigen::VectorXd& direction) const {
  Eigen::VectorXd scaled = direction.cwiseQuotient(column_scale);
  const double length = scaled.norm();
  if (!(length > 0) || singular_values.size() == 0 || !(singular_values[0] > 0)) return 0;
  scaled = scaled_right.transpose() * (scaled / length);
  return singular_values.cwiseProduct(scaled).norm() / singular_values[0];
}

bool NullSpace::contains(const Eigen::VectorXd& direction) const {
  // The direction is exact; its product with the matrix is limited by rounding and by what the rank leaves out
  return direction.norm() > 0 && observed_share(direction) <= std::max(tolerance, 1e-12);
}

namespace {

/// Gauss-Jordan elimination on the rows of B, with leftmost pivots that are not small.
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

/// Smallest multiple with integer entries, if it is small and remains in the space.
Eigen::VectorXd as_integers(const Eigen::VectorXd& v, const NullSpace& space) {
  constexpr int largest_multiple = 12, largest_entry = 60;
  for (int multiple = 1; multiple <= largest_multiple; ++multiple) {
    const Eigen::VectorXd scaled = v * multiple;
    Eigen::VectorXd whole = scaled.array().round();
    if ((scaled - whole).cwiseAbs().maxCoeff() < 1e-7 && whole.cwiseAbs().maxCoeff() <= largest_entry &&
        space.contains(whole))
      return whole;
  }
  return v;
}

}  // namespace

std::vector<Eigen::VectorXd> readable_basis(const NullSpace& space) {
  // In scaled coordinates, where a common threshold applies to all columns
  Eigen::MatrixXd B = space.scaled_null.transpose();
  reduce(B);
  std::vector<Eigen::VectorXd> vectors;
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    Eigen::VectorXd v = B.row(i);
    const double largest = v.cwiseAbs().maxCoeff();
    Eigen::Index leading = -1;
    for (Eigen::Index j = 0; j < v.size(); ++j) {
      if (std::abs(v[j]) < 1e-9 * largest) v[j] = 0;
      if (leading < 0 && v[j] != 0) leading = j;
    }
    v = v.cwiseProduct(space.column_scale / (v[leading] * space.column_scale[leading]));
    vectors.push_back(as_integers(v, space));
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
