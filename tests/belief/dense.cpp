#include "tests/belief/dense.hpp"

namespace incognita::testing {

Eigen::MatrixXd random_matrix(RandomStream& random, int rows, int columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

Eigen::MatrixXd random_covariance(RandomStream& random, int size) {
  const Eigen::MatrixXd a = random_matrix(random, size, size);
  return a * a.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

Map::Map(RandomStream& random, const std::vector<int>& vehicle_sizes,
         const std::vector<int>& landmark_sizes) {
  for (const int size : vehicle_sizes)
    vehicles.push_back(belief.add_vehicle(Chart::line(size), random_matrix(random, size, 1),
                                          random_covariance(random, size)));
  for (const int size : landmark_sizes) {
    std::vector<Belief::Parent> parents;
    for (const BlockId vehicle : vehicles)
      parents.push_back({vehicle, random_matrix(random, size, belief.chart(vehicle).tangent())});
    landmarks.push_back(belief.augment(Chart::line(size), random_matrix(random, size, 1), parents,
                                       random_covariance(random, size)));
  }
}

LinearizedMeasurement random_measurement(RandomStream& random, const Belief& belief, int rows,
                                         const std::vector<BlockId>& blocks) {
  LinearizedMeasurement measurement;
  for (const BlockId id : blocks)
    measurement.add(id, random_matrix(random, rows, belief.chart(id).tangent()));
  measurement.residual = random_matrix(random, rows, 1);
  measurement.R = random_covariance(random, rows);
  return measurement;
}

Stacked::Stacked(const Belief& belief, std::span<const LinearizedMeasurement> measurements) {
  int rows = 0;
  for (const LinearizedMeasurement& measurement : measurements) rows += measurement.rows();
  H = Eigen::MatrixXd::Zero(rows, belief.errors());
  R = Eigen::MatrixXd::Zero(rows, rows);
  residual.resize(rows);
  int row = 0;
  for (const LinearizedMeasurement& measurement : measurements) {
    for (int i = 0; i < measurement.part_count; ++i)
      H.block(row, belief.offset(measurement.parts[i].block), measurement.rows(),
              measurement.parts[i].H.cols()) += measurement.parts[i].H;
    R.block(row, row, measurement.rows(), measurement.rows()) = measurement.R;
    residual.segment(row, measurement.rows()) = measurement.residual;
    row += measurement.rows();
  }
}

Posterior textbook_update(const Eigen::MatrixXd& P, const Stacked& measurements) {
  const Eigen::MatrixXd S = measurements.H * P * measurements.H.transpose() + measurements.R;
  const Eigen::MatrixXd K = P * measurements.H.transpose() * S.inverse();
  return {P - K * S * K.transpose(), S, K * measurements.residual};
}

Eigen::VectorXd stacked_mean(const Belief& belief, const std::vector<BlockId>& ids) {
  Eigen::VectorXd mean(belief.errors());
  for (const BlockId id : ids) mean.segment(belief.offset(id), belief.mean(id).size()) = belief.mean(id);
  return mean;
}

::testing::AssertionResult close_covariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                            const Eigen::MatrixXd& prior, double tolerance) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return ::testing::AssertionFailure() << "sizes differ";
  const Eigen::VectorXd sigma = prior.diagonal().cwiseSqrt();
  for (int j = 0; j < a.cols(); ++j)
    for (int i = 0; i < a.rows(); ++i)
      if (!(std::abs(a(i, j) - b(i, j)) <= tolerance * sigma[i] * sigma[j]))
        return ::testing::AssertionFailure() << "at " << i << "," << j << ": " << a(i, j) << " and "
                                             << b(i, j) << ", scale " << sigma[i] * sigma[j];
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult close(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return ::testing::AssertionFailure() << "sizes differ";
  const double error = a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
  const double scale = a.size() == 0 ? 0 : b.cwiseAbs().maxCoeff();
  if (error <= tolerance * scale) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "differ by " << error << " at scale " << scale;
}

::testing::AssertionResult positive_definite(const Eigen::MatrixXd& P) {
  if (!P.allFinite()) return ::testing::AssertionFailure() << "not finite";
  // In units of the standard deviations, independent of scale
  const Eigen::VectorXd weights = P.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> llt(weights.asDiagonal() * P * weights.asDiagonal());
  if (llt.info() == Eigen::Success) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "not positive definite";
}

Photograph::Photograph(const Belief& belief, const std::vector<BlockId>& ids) : P(belief.dense_covariance()) {
  for (const BlockId id : ids) means.insert(means.end(), belief.mean(id).begin(), belief.mean(id).end());
}

}  // namespace incognita::testing
