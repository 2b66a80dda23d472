// The update of the information form: looks are added, then one solution for all.
#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "incognita/belief/information_belief.hpp"

namespace incognita {

/// Looks in units of their noise into white_. False when a noise is not positive definite or a residual not
/// finite.
bool InformationBelief::whiten_looks(std::span<const AffineLook> looks, UpdateReport& report) {
  white_.assign(looks.begin(), looks.end());
  for (AffineLook& look : white_) {
    const Eigen::LLT<LookMatrix> R(look.R);
    if (R.info() != Eigen::Success || !look.residual.allFinite()) return false;
    for (int i = 0; i < look.rows(); ++i) report.log_det_R += 2 * std::log(R.matrixLLT()(i, i));
    R.matrixL().solveInPlace(look.residual);
    for (int i = 0; i < look.part_count; ++i) R.matrixL().solveInPlace(look.parts[i].H);
  }
  return true;
}

/// add(row, column, value) for all elements of H' R^-1 H on and below the diagonal.
template <class Add>
void InformationBelief::add_looks(const Add& add) const {
  for (const AffineLook& look : white_)
    for (int a = 0; a < look.part_count; ++a)
      for (int b = 0; b < look.part_count; ++b) {
        const LookJacobian &Ha = look.parts[a].H, &Hb = look.parts[b].H;
        const int row = block(look.parts[a].block).error, column = block(look.parts[b].block).error;
        for (int j = 0; j < Hb.cols(); ++j)
          for (int i = 0; i < Ha.cols(); ++i)
            if (row + i >= column + j) add(row + i, column + j, Ha.col(i).dot(Hb.col(j)));
      }
}

/// posterior_ <- factor of the information with the looks, delta_ <- what they add to the errors. False when
/// they can not be used within rounding.
bool InformationBelief::solve(std::span<const AffineLook> looks, UpdateReport& report) {
  report.rows = check(looks);
  if (!whiten_looks(looks, report)) return false;
  posterior_.load(information_, errors_);
  add_looks([&](int i, int j, double value) { posterior_.add(i, j, value); });
  if (!posterior_.factorise()) return false;
  delta_ = Eigen::VectorXd::Zero(errors_);  // first the information vector
  for (const AffineLook& look : white_)
    for (int i = 0; i < look.part_count; ++i)
      delta_.segment(block(look.parts[i].block).error, look.parts[i].H.cols()) +=
          look.parts[i].H.transpose() * look.residual;
  posterior_.solve(delta_);
  return delta_.allFinite();
}

UpdateReport InformationBelief::update(std::span<const AffineLook> looks) {
  UpdateReport report;
  if (looks.empty()) return report;
  const ReverseFactor* prior = factor();
  if (prior == nullptr || !solve(looks, report)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  // What the update leaves of residuals and errors, each in its own units, is residual' S^-1 residual: a sum
  // of squares, where r' R^-1 r - delta' information delta would be a small difference of large numbers
  const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> information(
      information_.storage.data(), errors_, errors_, Eigen::OuterStride<>(information_.stride));
  report.nis = delta_.dot(information.selfadjointView<Eigen::Lower>() * delta_);
  for (const AffineLook& look : white_) {
    LookVector left = look.residual;
    for (int i = 0; i < look.part_count; ++i)
      left -= look.parts[i].H * delta_.segment(block(look.parts[i].block).error, look.parts[i].H.cols());
    report.nis += left.squaredNorm();
  }
  // det S = det R * det(information with the looks) / det(information without)
  report.log_det_S = report.log_det_R + posterior_.log_det() - prior->log_det();
  add_looks([&](int i, int j, double value) { information_.column(j)[i] += value; });
  std::swap(factor_, posterior_);
  shift_mean({delta_.data(), static_cast<std::size_t>(errors_)});
  report.outcome = UpdateReport::Outcome::updated;
  note(looks);
  return report;
}

bool InformationBelief::correction(std::span<const AffineLook> looks, std::span<const BlockId> blocks,
                                   std::span<BlockVector> out) {
  UpdateReport report;
  if (looks.empty() || !solve(looks, report)) return false;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& b = block(blocks[i]);
    out[i] = delta_.segment(b.error, b.chart.tangent());
  }
  return true;
}

void InformationBelief::innovation_covariance(std::span<const AffineLook> looks, Eigen::MatrixXd& S) const {
  const int rows = check(looks);
  S.resize(rows, rows);
  int row = 0;
  for (const AffineLook& a : looks) {
    int column = 0;
    for (const AffineLook& b : looks) {
      LookMatrix sum = LookMatrix::Zero(a.rows(), b.rows());
      if (row == column) sum = a.R;
      for (int i = 0; i < a.part_count; ++i)
        for (int j = 0; j < b.part_count; ++j)
          sum += a.parts[i].H * covariance(a.parts[i].block, b.parts[j].block) * b.parts[j].H.transpose();
      S.block(row, column, a.rows(), b.rows()) = sum;
      column += b.rows();
    }
    row += a.rows();
  }
}

}  // namespace incognita
