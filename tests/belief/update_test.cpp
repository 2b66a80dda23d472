// predict and update against the printed formulas on dense matrices.
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

std::vector<BlockId> all(const Map& map) {
  std::vector<BlockId> ids = map.vehicles;
  ids.insert(ids.end(), map.landmarks.begin(), map.landmarks.end());
  return ids;
}

std::vector<LinearizedMeasurement> linearize_at(RandomStream& random, const Map& map,
                                                const std::vector<int>& landmarks) {
  std::vector<LinearizedMeasurement> measurements;
  for (const int i : landmarks)
    measurements.push_back(random_measurement(
        random, map.belief, 1 + i % 3,
        {map.vehicles[static_cast<std::size_t>(i) % map.vehicles.size()], map.landmarks[i]}));
  return measurements;
}

/// Scales the errors of a block and their Jacobians by a factor: the same problem in other units.
void rescale(LinearizedMeasurement& measurement, BlockId block, double factor) {
  for (int i = 0; i < measurement.part_count; ++i)
    if (measurement.parts[i].block == block) measurement.parts[i].H /= factor;
}

TEST(Update, EqualsTheTextbookForAnyBlocksAndSizes) {
  RandomStream random(1, "update");
  for (int run = 0; run < 200; ++run) {
    std::vector<int> landmarks(1 + random.below(12));
    for (int& size : landmarks) size = 1 + random.below(6);
    Map map(random, {1 + random.below(16), 3}, landmarks);
    std::vector<LinearizedMeasurement> measurements;
    for (int i = 1 + random.below(8); i > 0; --i) {  // a block may occur twice, in any order
      std::vector<BlockId> blocks;
      for (int k = 1 + random.below(3); k > 0; --k) blocks.push_back(random.below(map.belief.block_count()));
      measurements.push_back(random_measurement(random, map.belief, 1 + random.below(6), blocks));
    }
    const Eigen::MatrixXd P = map.belief.dense_covariance();
    const Eigen::VectorXd mean = stacked_mean(map.belief, all(map));
    const Stacked stacked(map.belief, measurements);
    const Posterior expected = textbook_update(P, stacked);
    Eigen::MatrixXd S;
    map.belief.innovation_covariance(measurements, S);
    EXPECT_TRUE(close(S, expected.S, 1e-12));
    const UpdateReport report = map.belief.update(measurements);
    ASSERT_EQ(report.outcome, UpdateReport::Outcome::updated);
    EXPECT_EQ(report.rows, stacked.residual.size());
    EXPECT_TRUE(close_covariance(map.belief.dense_covariance(), expected.P, P, 1e-10));
    EXPECT_TRUE(close(stacked_mean(map.belief, all(map)), mean + expected.delta, 1e-9));
    const double nis = stacked.residual.dot(expected.S.ldlt().solve(stacked.residual));
    EXPECT_NEAR(report.nis, nis, 1e-8 * nis);
  }
}

TEST(Update, EqualsTheTextbookAcrossTileBorders) {
  RandomStream random(2, "sizes");
  for (int landmarks = 0; landmarks <= 70; ++landmarks) {
    Map map(random, {2}, std::vector<int>(landmarks, 1));
    std::vector<LinearizedMeasurement> measurements = {
        random_measurement(random, map.belief, 2, {map.vehicles[0]})};
    if (landmarks > 0)
      measurements.push_back(
          random_measurement(random, map.belief, 1, {map.landmarks.back(), map.vehicles[0]}));
    const Eigen::MatrixXd P = map.belief.dense_covariance();
    const Posterior expected = textbook_update(P, Stacked(map.belief, measurements));
    map.belief.update(measurements);
    ASSERT_TRUE(close_covariance(map.belief.dense_covariance(), expected.P, P, 1e-11)) << landmarks;
  }
}

TEST(Update, OfATeamEqualsTheTextbookAndSequentialUpdates) {
  RandomStream random(6, "team");
  Map map(random, std::vector<int>(8, 3), std::vector<int>(90, 2));
  std::vector<LinearizedMeasurement>
      measurements;  // 224 rows: more than one tile of the factorization and of the subtraction
  for (int i = 0; i < 112; ++i) {
    const BlockId viewer = map.vehicles[static_cast<std::size_t>(i / 14)];
    const BlockId seen = i % 14 == 0 ? map.vehicles[static_cast<std::size_t>((i / 14 + 1) % 8)]
                                     : map.landmarks[static_cast<std::size_t>(7 * i % 90)];
    measurements.push_back(random_measurement(random, map.belief, 2, {viewer, seen}));
  }
  const Eigen::MatrixXd P = map.belief.dense_covariance();
  const Posterior expected = textbook_update(P, Stacked(map.belief, measurements));
  Belief in_turns = map.belief;
  ASSERT_EQ(map.belief.update(measurements).outcome, UpdateReport::Outcome::updated);
  for (std::size_t i = 0; i < measurements.size(); i += 14) in_turns.update({&measurements[i], 14});
  EXPECT_TRUE(close_covariance(map.belief.dense_covariance(), expected.P, P, 1e-10));
  EXPECT_TRUE(close_covariance(map.belief.dense_covariance(), in_turns.dense_covariance(), P, 1e-10));
}

TEST(Update, EqualsTheJosephFormAtAnyScale) {
  for (const double scale : {1e-8, 1e-4, 1.0, 1e4, 1e8}) {
    RandomStream random(3, "scales");
    Map map(random, {6}, {3, 3, 3});
    // One landmark and one measurement in other units than the rest
    const BlockId odd = map.landmarks[1];
    const BlockMatrix J = scale * BlockMatrix::Identity(3, 3);
    map.belief.replace(odd, Chart::line(3), map.belief.mean(odd) * scale, J, BlockMatrix::Zero(3, 3));
    std::vector<LinearizedMeasurement> measurements = linearize_at(random, map, {0, 1, 2});
    for (LinearizedMeasurement& measurement : measurements) rescale(measurement, odd, scale);
    measurements[2].R *= scale * scale;
    for (int i = 0; i < measurements[2].part_count; ++i) measurements[2].parts[i].H *= scale;
    measurements[2].residual *= scale;
    Belief joseph = map.belief;
    const Eigen::MatrixXd prior = map.belief.dense_covariance();
    const UpdateReport ours = map.belief.update(measurements), theirs = joseph.update_joseph(measurements);
    ASSERT_EQ(ours.outcome, UpdateReport::Outcome::updated) << scale;
    ASSERT_EQ(theirs.outcome, UpdateReport::Outcome::updated) << scale;
    EXPECT_NEAR(ours.nis, theirs.nis, 1e-12 * theirs.nis);
    EXPECT_TRUE(close_covariance(map.belief.dense_covariance(), joseph.dense_covariance(), prior, 1e-9))
        << scale;
    for (const BlockId id : all(map)) EXPECT_TRUE(close(map.belief.mean(id), joseph.mean(id), 1e-9)) << scale;
  }
}

TEST(Update, EqualsTheJosephFormForVeryPreciseMeasurements) {
  for (const double sigma : {1.0, 1e-2, 1e-4}) {
    RandomStream random(4, "precise");
    Map map(random, {6}, {3, 3, 3});
    std::vector<LinearizedMeasurement> measurements = linearize_at(random, map, {0, 1, 2});
    for (LinearizedMeasurement& measurement : measurements) measurement.R *= sigma * sigma;
    Belief joseph = map.belief;
    const Eigen::MatrixXd prior = map.belief.dense_covariance();
    ASSERT_EQ(map.belief.update(measurements).outcome, UpdateReport::Outcome::updated);
    joseph.update_joseph(measurements);
    EXPECT_TRUE(close_covariance(map.belief.dense_covariance(), joseph.dense_covariance(), prior, 1e-9))
        << sigma;
    EXPECT_TRUE(positive_definite(map.belief.dense_covariance())) << sigma;
  }
}

TEST(Update, SequentialMeasurementsEqualSimultaneousOnes) {
  RandomStream random(5, "sequential");
  Map map(random, {6, 4}, {3, 6, 3, 2, 3});
  const std::vector<LinearizedMeasurement> measurements = linearize_at(random, map, {0, 1, 2, 3, 4});
  Belief sequential = map.belief;
  const Eigen::VectorXd start = stacked_mean(map.belief, all(map));
  const Eigen::MatrixXd prior = map.belief.dense_covariance();
  double log_det_S = 0, nis = 0;
  for (LinearizedMeasurement measurement :
       measurements) {  // linear: the remaining residual follows from the change of the mean
    const Stacked alone(sequential, {&measurement, 1});
    measurement.residual -= alone.H * (stacked_mean(sequential, all(map)) - start);
    const UpdateReport report = sequential.update({&measurement, 1});
    log_det_S += report.log_det_S;
    nis += report.nis;
  }
  const UpdateReport batch = map.belief.update(measurements);
  EXPECT_TRUE(close_covariance(sequential.dense_covariance(), map.belief.dense_covariance(), prior, 1e-11));
  EXPECT_TRUE(close(stacked_mean(sequential, all(map)), stacked_mean(map.belief, all(map)), 1e-10));
  EXPECT_NEAR(log_det_S, batch.log_det_S, 1e-9);
  EXPECT_NEAR(nis, batch.nis, 1e-9 * nis);
}

double log_det(const Eigen::MatrixXd& P) {
  return 2 * Eigen::LLT<Eigen::MatrixXd>(P).matrixLLT().diagonal().array().log().sum();
}

TEST(Update, ReducesTheEntropyByThatOfTheInnovation) {  // thesis (6.6)
  RandomStream random(6, "information");
  for (int run = 0; run < 20; ++run) {
    Map map(random, {6}, {3, 3, 3, 3});
    const std::vector<LinearizedMeasurement> measurements = linearize_at(random, map, {0, 1, 2, 3});
    const double before = log_det(map.belief.dense_covariance());
    const UpdateReport report = map.belief.update(measurements);
    const double taken = (before - log_det(map.belief.dense_covariance())) / 2;
    EXPECT_NEAR((report.log_det_S - report.log_det_R) / 2, taken, 1e-9 * (1 + taken));
    EXPECT_GT(taken, 0);
  }
}

TEST(Update, WithoutMeasurementsChangesNothing) {
  RandomStream random(7, "nothing");
  Map map(random, {3}, {2});
  const Photograph before(map.belief, all(map));
  EXPECT_EQ(map.belief.update({}).outcome, UpdateReport::Outcome::nothing);
  EXPECT_EQ(map.belief.update_joseph({}).outcome, UpdateReport::Outcome::nothing);
  EXPECT_TRUE(Photograph(map.belief, all(map)) == before);
}

TEST(Update, KeepsExactKnowledge) {  // a robot that defines the origin starts with no variance at all
  Belief belief;
  const BlockId vehicle =
      belief.add_vehicle(Chart::line(2), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero());
  const Belief::Parent parent{vehicle, BlockMatrix::Identity(2, 2)};
  const BlockId landmark =
      belief.augment(Chart::line(2), Eigen::Vector2d(1, 2), {&parent, 1}, Eigen::Matrix2d::Identity());
  LinearizedMeasurement measurement;
  measurement.add(vehicle, -Eigen::Matrix2d::Identity());
  measurement.add(landmark, Eigen::Matrix2d::Identity());
  measurement.residual = Eigen::Vector2d(1, 1);
  measurement.R = Eigen::Matrix2d::Identity();
  ASSERT_EQ(belief.update({&measurement, 1}).outcome, UpdateReport::Outcome::updated);
  EXPECT_EQ(belief.covariance(vehicle), BlockMatrix::Zero(2, 2));
  EXPECT_TRUE(close(belief.covariance(landmark), 0.5 * Eigen::Matrix2d::Identity(), 1e-15));
  EXPECT_TRUE(close(belief.mean(landmark), Eigen::Vector2d(1.5, 2.5), 1e-15));
}

TEST(Predict, EqualsTheTextbookForEachVehicleAndForLandmarks) {
  RandomStream random(8, "predict");
  for (int run = 0; run < 50; ++run) {
    std::vector<int> landmarks(random.below(60));
    for (int& size : landmarks) size = 1 + random.below(6);
    Map map(random, {12, 3, 1 + random.below(16)}, landmarks);
    const BlockId moved = random.below(map.belief.block_count());
    const int size = map.belief.chart(moved).tangent(), first = map.belief.offset(moved);
    const LinearizedMotion motion{moved, random_matrix(random, size, 1), random_matrix(random, size, size),
                                  random_covariance(random, size)};
    const Eigen::MatrixXd P = map.belief.dense_covariance();
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(P.rows(), P.cols()),
                    N = Eigen::MatrixXd::Zero(P.rows(), P.cols());
    F.block(first, first, size, size) = motion.A;
    N.block(first, first, size, size) = motion.N;
    Eigen::VectorXd mean = stacked_mean(map.belief, all(map));
    mean.segment(first, size) = motion.x_next;
    map.belief.predict(motion);
    ASSERT_TRUE(close(map.belief.dense_covariance(), F * P * F.transpose() + N, 1e-13));
    EXPECT_EQ(stacked_mean(map.belief, all(map)), mean);
  }
}

}  // namespace
}  // namespace incognita::testing
