// The update in information form: measurements are added, then one solve gives all means.
#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "incognita/belief/information_belief.hpp"

namespace incognita {

/// white_ <- the measurements scaled to unit noise. False when a noise covariance is not positive definite or
/// a residual not finite.
bool InformationBelief::whiten_measurements(std::span<const LinearizedMeasurement> measurements,
                                            UpdateReport& report) {
  white_.assign(measurements.begin(), measurements.end());
  for (LinearizedMeasurement& measurement : white_) {
    const Eigen::LLT<MeasurementMatrix> R(measurement.R);
    if (R.info() != Eigen::Success || !measurement.residual.allFinite()) return false;
    for (int i = 0; i < measurement.rows(); ++i) report.log_det_R += 2 * std::log(R.matrixLLT()(i, i));
    R.matrixL().solveInPlace(measurement.residual);
    for (int i = 0; i < measurement.part_count; ++i) R.matrixL().solveInPlace(measurement.parts[i].H);
  }
  return true;
}

/// Calls add(row, column, value) for the elements of H' R^-1 H on and below the diagonal.
template <class Add>
void InformationBelief::add_measurements(const Add& add) const {
  for (const LinearizedMeasurement& measurement : white_)
    for (int a = 0; a < measurement.part_count; ++a)
      for (int b = 0; b < measurement.part_count; ++b) {
        const MeasurementJacobian &Ha = measurement.parts[a].H, &Hb = measurement.parts[b].H;
        const int row = block(measurement.parts[a].block).error,
                  column = block(measurement.parts[b].block).error;
        for (int j = 0; j < Hb.cols(); ++j)
          for (int i = 0; i < Ha.cols(); ++i)
            if (row + i >= column + j) add(row + i, column + j, Ha.col(i).dot(Hb.col(j)));
      }
}

/// posterior_ <- factor of the posterior information, delta_ <- correction of the errors. False when the
/// measurements are not usable within rounding.
bool InformationBelief::solve(std::span<const LinearizedMeasurement> measurements, UpdateReport& report) {
  report.rows = check(measurements);
  if (!whiten_measurements(measurements, report)) return false;
  posterior_.load(information_, errors_);
  add_measurements([&](int i, int j, double value) { posterior_.add(i, j, value); });
  if (!posterior_.factorize()) return false;
  delta_ = Eigen::VectorXd::Zero(errors_);  // the information vector at first
  for (const LinearizedMeasurement& measurement : white_)
    for (int i = 0; i < measurement.part_count; ++i)
      delta_.segment(block(measurement.parts[i].block).error, measurement.parts[i].H.cols()) +=
          measurement.parts[i].H.transpose() * measurement.residual;
  posterior_.solve(delta_);
  return delta_.allFinite();
}

UpdateReport InformationBelief::update(std::span<const LinearizedMeasurement> measurements) {
  UpdateReport report;
  if (measurements.empty()) return report;
  const ReverseFactor* prior = factor();
  if (prior == nullptr || !solve(measurements, report)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  // NIS = residual' S^-1 residual, as the sum of squares of the whitened posterior residuals and errors. r'
  // R^-1 r - delta' information delta would suffer from cancellation.
  const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> information(
      information_.storage.data(), errors_, errors_, Eigen::OuterStride<>(information_.stride));
  report.nis = delta_.dot(information.selfadjointView<Eigen::Lower>() * delta_);
  for (const LinearizedMeasurement& measurement : white_) {
    MeasurementVector left = measurement.residual;
    for (int i = 0; i < measurement.part_count; ++i)
      left -= measurement.parts[i].H *
              delta_.segment(block(measurement.parts[i].block).error, measurement.parts[i].H.cols());
    report.nis += left.squaredNorm();
  }
  // det S = det R * det(posterior information) / det(prior information)
  report.log_det_S = report.log_det_R + posterior_.log_det() - prior->log_det();
  add_measurements([&](int i, int j, double value) { information_.column(j)[i] += value; });
  std::swap(factor_, posterior_);
  shift_mean({delta_.data(), static_cast<std::size_t>(errors_)});
  report.outcome = UpdateReport::Outcome::updated;
  note(measurements);
  return report;
}

bool InformationBelief::correction(std::span<const LinearizedMeasurement> measurements,
                                   std::span<const BlockId> blocks, std::span<BlockVector> out) {
  UpdateReport report;
  if (measurements.empty() || !solve(measurements, report)) return false;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& b = block(blocks[i]);
    out[i] = delta_.segment(b.error, b.chart.tangent());
  }
  return true;
}

void InformationBelief::innovation_covariance(std::span<const LinearizedMeasurement> measurements,
                                              Eigen::MatrixXd& S) const {
  const int rows = check(measurements);
  S.resize(rows, rows);
  int row = 0;
  for (const LinearizedMeasurement& a : measurements) {
    int column = 0;
    for (const LinearizedMeasurement& b : measurements) {
      MeasurementMatrix sum = MeasurementMatrix::Zero(a.rows(), b.rows());
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
