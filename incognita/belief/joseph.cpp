// The update in Joseph form on dense matrices: the reference for tests of the fast update.
#include <Eigen/Cholesky>
#include <stdexcept>

#include "incognita/belief/belief.hpp"

namespace incognita {

UpdateReport Belief::update_joseph(std::span<const LinearizedMeasurement> measurements) {
  if (correlations_ == MapCorrelations::block_diagonal)
    throw std::logic_error("update_joseph: not available with a block-diagonal map");
  UpdateReport report;
  if (measurements.empty()) return report;
  if (!factorize_innovation(measurements, report)) {
    report.outcome = UpdateReport::Outcome::singular;
    return report;
  }
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(report.rows, errors_);
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(report.rows, report.rows);
  Eigen::VectorXd residual(report.rows);
  int row = 0;
  for (const LinearizedMeasurement& measurement : measurements) {
    for (int i = 0; i < measurement.part_count; ++i) {
      const Block& b = block(measurement.parts[i].block);
      H.block(row, b.error, measurement.rows(), b.chart.tangent()) += measurement.parts[i].H;
    }
    R.block(row, row, measurement.rows(), measurement.rows()) = measurement.R;
    residual.segment(row, measurement.rows()) = measurement.residual;
    row += measurement.rows();
  }
  const Eigen::MatrixXd full = dense_covariance();
  const Eigen::MatrixXd S = H * full * H.transpose() + R;
  const Eigen::MatrixXd K = S.llt().solve(H * full).transpose();  // (A.1.9)
  const Eigen::MatrixXd I_KH = Eigen::MatrixXd::Identity(errors_, errors_) - K * H;
  P() = I_KH * full * I_KH.transpose() + K * R * K.transpose();  // (A.2.7)
  const Eigen::VectorXd delta = K * residual;
  shift_mean({delta.data(), static_cast<std::size_t>(errors_)});
  report.outcome = UpdateReport::Outcome::updated;
  note(measurements);
  return report;
}

}  // namespace incognita
