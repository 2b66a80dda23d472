// The monitor's information matrix against a dense reference: ranks and all values.
#include "incognita/analysis/observability/observability_monitor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "incognita/belief/belief.hpp"
#include "incognita/math/random.hpp"
#include "tests/analysis/monitor_reference.hpp"

namespace incognita {
namespace {

using namespace testing;

TEST(ObservabilityMonitor, EqualsTheInformationFilterWithoutPrior) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    MonitorAndReference both(seed, 4);
    for (int step = 0; step < 6; ++step) {
      both.move(2, 0.5);
      if (step % 3 == 1) both.move(2, 0.2);  // two motions in a row
      for (const BlockId id : both.live)
        both.add_measurement(id, 1 + static_cast<int>((id + static_cast<unsigned>(step)) % 2));
      if (step % 2 == 0) both.initialize(3, 1);
      if (step == 3) both.add_measurement(vehicle, 2);
      both.compare("measurements and initializations");
      if (step == 2) both.replace(1, 2, false);
      if (step == 3) both.replace(2, 3, true);
      both.compare("replaced");
      if (step == 4) both.drop(2);
      both.compare("dropped");
    }
  }
}

TEST(ObservabilityMonitor, ReplacementMayKeepTheSize) {
  MonitorAndReference both(11, 4);
  for (int i = 0; i < 3; ++i) both.initialize(3, 1);
  for (int round = 0; round < 3; ++round)
    for (const BlockId id : both.live) both.add_measurement(id, 2);
  both.replace(2, 3, false);
  both.compare("without noise");
  both.replace(1, 3, true);
  both.compare("with noise along one direction");
}

/// The information is that of measurements with more noise, whatever moves the block.
TEST(ObservabilityMonitor, TakesABlockAsNoise) {
  constexpr BlockId body = 0, error = 1, point = 2;
  ObservabilityMonitor with(body, 3), plain(body, 3);
  const Eigen::Matrix2d cov = (Eigen::Matrix2d() << 0.3, 0.1, 0.1, 0.2).finished();
  with.treat_as_noise(error, cov);
  RandomStream random(5, "noise");
  const auto matrix = [&](int rows, int columns) {
    MatrixXd A(rows, columns);
    for (double& a : A.reshaped()) a = random.normal();
    return A;
  };
  for (int i = 0; i < 8; ++i) {
    const MatrixXd Hv = matrix(2, 3), He = matrix(2, 2), Hl = matrix(2, 3);
    LinearizedMeasurement measurement, noisier;
    measurement.add(body, Hv);
    measurement.add(error, He);
    measurement.add(point, Hl);
    noisier.add(body, Hv);
    noisier.add(point, Hl);
    measurement.residual = noisier.residual = Eigen::Vector2d::Zero();
    measurement.R = 0.1 * Eigen::Matrix2d::Identity();
    noisier.R = measurement.R + He * cov * He.transpose();
    with.add_measurement(measurement);
    plain.add_measurement(noisier);
    const LinearizedMotion motion{body, Eigen::Vector3d::Zero(), matrix(3, 3),
                                  0.01 * Eigen::Matrix3d::Identity()};
    with.move(motion);
    plain.move(motion);
    with.move({error, Eigen::Vector2d::Zero(), 0.5 * Eigen::Matrix2d::Identity(), cov});
  }
  EXPECT_FALSE(with.uncovered());
  const MatrixXd Y = with.information(), expected = plain.information();
  ASSERT_EQ(Y.rows(), 6);
  EXPECT_LT((Y - expected).norm(), 1e-10 * expected.norm());
}

// The replaced block has no information left, and the other blocks keep what it constrained
TEST(ObservabilityMonitor, ReplacementByPureNoiseIsANewBlock) {
  MonitorAndReference both(12, 4);
  for (int i = 0; i < 3; ++i) both.initialize(3, 1);
  for (int round = 0; round < 3; ++round)
    for (const BlockId id : both.live) both.add_measurement(id, 2);
  ObservabilityMonitor dropped = both.monitor;
  dropped.drop(3);
  both.monitor.replace({3, MatrixXd::Identity(2, 3), MatrixXd::Identity(2, 2)});
  const MatrixXd Y = both.monitor.information(), expected = dropped.information();
  ASSERT_EQ(Y.rows(), expected.rows() + 2);
  EXPECT_TRUE(Y.bottomRows(2).isZero(0));
  EXPECT_LT((Y.topLeftCorner(10, 10) - expected).norm(), 1e-9 * expected.norm());
}

/// The system as a stacked observability matrix: each measurement is a row over the initial vehicle errors
/// and all blocks that ever existed. Measurements are few and scalar, so that much stays unobservable.
struct StackedSystem {
  explicit StackedSystem(std::uint64_t seed) : random(seed, "stacked"), monitor(vehicle, errors) {}

  void move() {
    LinearizedMotion m;
    m.block = vehicle;
    m.A = MatrixXd::Identity(errors, errors) + 0.3 * random_matrix(random, errors, errors);
    const MatrixXd G = random_matrix(random, errors, 2);
    m.N = G * G.transpose();
    Phi = (m.A * Phi).eval();
    monitor.move(m);
  }
  void add_measurement(BlockId id) {
    LinearizedMeasurement measurement;
    const MatrixXd Hv = random_matrix(random, 1, errors), Hl = random_matrix(random, 1, size);
    measurement.add(vehicle, Hv);
    measurement.add(id, Hl);
    measurement.R = MatrixXd::Identity(1, 1);
    measurement.residual = VectorXd::Zero(1);
    monitor.add_measurement(measurement);
    MatrixXd row = MatrixXd::Zero(1, errors + size * blocks);
    row.leftCols(errors) = Hv * Phi;
    row.middleCols(errors + size * (id - 1), size) = Hl;
    M.conservativeResize(M.rows() + 1, row.cols());
    M.bottomRows(1) = row;
  }

  static constexpr int errors = 4, size = 2, blocks = 5;
  RandomStream random;
  ObservabilityMonitor monitor;
  MatrixXd Phi = MatrixXd::Identity(errors, errors);
  MatrixXd M = MatrixXd::Zero(0, errors + size * blocks);
};

// Motions with an invertible transition do not change the unobservable space, whatever their noise
TEST(ObservabilityMonitor, HasTheRankOfTheStackedMatrix) {
  int poor = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    StackedSystem system(seed);
    for (BlockId id = 1; id <= StackedSystem::blocks; ++id) system.add_measurement(id);
    for (int step = 0; step < 4; ++step) {
      system.move();
      for (BlockId id = 1; id <= StackedSystem::blocks; ++id)
        if (system.random.below(3) == 0) system.add_measurement(id);
    }
    const std::vector<BlockId> dropped{2, 5};
    for (const BlockId id : dropped) system.monitor.drop(id);
    MatrixXd gone(system.M.rows(), 4);  // the rank that remains when columns are eliminated
    gone << system.M.middleCols(6, 2), system.M.middleCols(12, 2);
    const Eigen::Index left = rank_of(system.M) - rank_of(gone);
    ASSERT_EQ(rank_of(system.monitor.information()), left) << "seed " << seed;
    poor += left < 10;
  }
  EXPECT_GT(poor, 20);
}

/// Position and velocity with noise that enters as an acceleration: N has rank 3 of 6, and with equal
/// variances half of the pivots vanish.
TEST(ObservabilityMonitor, AcceptsRankDeficientProcessNoise) {
  const double dt = 1.0 / 30;
  RandomStream random(3, "correlated");
  for (int run = 0; run < 20; ++run) {
    ObservabilityMonitor monitor(vehicle, 6);
    DenseReference reference(6);
    for (int step = 0; step < 5; ++step) {
      LinearizedMeasurement measurement;
      const MatrixXd H = random_matrix(random, 3, 6);
      measurement.add(vehicle, H);
      measurement.R = 0.01 * MatrixXd::Identity(3, 3);
      measurement.residual = VectorXd::Zero(3);
      monitor.add_measurement(measurement);
      reference.add(H, measurement.R);
      LinearizedMotion m;
      m.block = vehicle;
      m.A = MatrixXd::Identity(6, 6);
      m.A.topRightCorner(3, 3) = dt * MatrixXd::Identity(3, 3);
      MatrixXd G = MatrixXd::Zero(6, 3);
      for (int i = 0; i < 3; ++i) {
        G(i, i) = dt * dt * random.uniform(1, 5);
        G(3 + i, i) = G(i, i) / dt;
      }
      m.N = G * G.transpose();
      monitor.move(m);
      reference.move(m);
      EXPECT_LT((monitor.information() - reference.Y).norm(), 1e-9 * reference.Y.norm()) << step;
    }
  }
}

// As for a camera whose velocity is set to zero: the information on pose and map remains
TEST(ObservabilityMonitor, SingularMotionRemovesOnlyItsNullSpace) {
  MonitorAndReference both(7, 4);
  for (int i = 0; i < 3; ++i) both.initialize(2, 0);
  both.measure_all(4);
  MatrixXd rest = MatrixXd::Identity(4, 4);
  rest(3, 3) = 0;
  both.move(rest, 4, 1);
  const MatrixXd at_rest = both.monitor.information();
  EXPECT_LT(at_rest.row(3).norm(), 1e-12 * at_rest.norm());
  EXPECT_EQ(rank_of(at_rest), 9);
  both.compare("at rest");
  both.measure_all(3);
  both.move(3, 0.5);
  both.compare("and on");
}

// The result along the forgotten directions is arbitrary, so that only the others are compared
TEST(ObservabilityMonitor, SingularMotionMayForgetObliqueDirections) {
  MonitorAndReference both(17, 4);
  for (int i = 0; i < 3; ++i) both.initialize(2, 0);
  both.measure_all(4);
  RandomStream random(8, "skew");
  const MatrixXd to = random_matrix(random, 4, 2);
  both.move(to * random_matrix(random, 2, 4), 0, 0);
  MatrixXd rest = MatrixXd::Zero(10, 8);
  rest.topLeftCorner(4, 2) = to;
  rest.bottomRightCorner(6, 6).setIdentity();
  const MatrixXd expected = rest.transpose() * both.reference.of(both.monitor.blocks()) * rest;
  EXPECT_EQ(rank_of(expected), 8);
  EXPECT_LT((rest.transpose() * both.monitor.information() * rest - expected).norm(), 1e-9 * expected.norm());
}

TEST(ObservabilityMonitor, MotionThatForgetsAllKeepsTheMap) {
  MonitorAndReference both(9, 4);
  for (int i = 0; i < 3; ++i) both.initialize(2, 0);
  both.measure_all(4);
  both.move(MatrixXd::Zero(4, 4), 4, 1);
  const MatrixXd Y = both.monitor.information();
  EXPECT_TRUE(Y.topRows(4).isZero(0));
  EXPECT_EQ(rank_of(Y), 6);
  both.compare("forgotten");
}

// Each motion shrinks an error slightly, all together below rounding, and none forgets it
TEST(ObservabilityMonitor, ManyContractionsAreNotASingularMotion) {
  MonitorAndReference both(10, 4);
  for (int i = 0; i < 3; ++i) both.initialize(2, 0);
  both.measure_all(4);
  MatrixXd slower = MatrixXd::Identity(4, 4);
  slower(3, 3) = 0.5;
  for (int i = 0; i < 60; ++i) both.move(slower, 4, 0.1);
  EXPECT_EQ(rank_of(both.monitor.information()), 10);
  both.compare("slower and slower");
}

TEST(ObservabilityMonitor, UnitOfLengthDoesNotMakeAMotionSingular) {
  const double per_m = 1e6;  // the vehicle rotates about a point 1 km away
  ObservabilityMonitor monitor(vehicle, 3);
  LinearizedMeasurement measurement;
  measurement.add(vehicle, Eigen::Vector3d(1 / per_m, 1 / per_m, 1).asDiagonal().toDenseMatrix());
  measurement.residual = VectorXd::Zero(3);
  measurement.R = MatrixXd::Identity(3, 3);
  monitor.add_measurement(measurement);
  LinearizedMotion motion;
  motion.block = vehicle;
  motion.A = MatrixXd::Identity(3, 3);
  motion.A.topRightCorner(2, 1) << -1e3 * per_m, 1e3 * per_m;
  motion.N = MatrixXd::Zero(3, 3);
  monitor.move(motion);
  const Eigen::Vector3d m(per_m, per_m, 1e-3);  // scale of each error for a rotation about a point 1 km away
  EXPECT_EQ(rank_of(m.asDiagonal() * monitor.information() * m.asDiagonal()), 3);
}

// Only simultaneous measurements of several landmarks from one pose carry information
TEST(ObservabilityMonitor, UninformativeMotionsRemoveTheVehicle) {
  ObservabilityMonitor measurements(vehicle, 4, ObservabilityMonitor::Motions::uninformative);
  MatrixXd of_map = MatrixXd::Zero(6, 6);
  RandomStream random(13, "nothing");
  for (int step = 0; step < 5; ++step) {
    MatrixXd H = random_matrix(random, 6, 10);
    for (BlockId id = 1; id <= 3; ++id) {
      const auto i = static_cast<Eigen::Index>(id);
      MatrixXd own = MatrixXd::Zero(2, 6);
      own.middleCols<2>(2 * (i - 1)) = H.block<2, 2>(2 * (i - 1), 4);
      H.block<2, 6>(2 * (i - 1), 4) = own;
      LinearizedMeasurement measurement;
      measurement.add(vehicle, H.block<2, 4>(2 * (i - 1), 0));
      measurement.add(id, own.middleCols<2>(2 * (i - 1)));
      measurement.residual = VectorXd::Zero(2);
      measurement.R = MatrixXd::Identity(2, 2);
      measurements.add_measurement(measurement);
    }
    LinearizedMotion motion;
    motion.block = vehicle;
    motion.A = MatrixXd::Identity(4, 4);
    motion.N = MatrixXd::Zero(4, 4);
    measurements.move(motion);
    const MatrixXd Hv = H.leftCols(4), Hm = H.rightCols(6);
    of_map += Hm.transpose() * (MatrixXd::Identity(6, 6) - Hv * pseudo_inverse(Hv)) * Hm;
  }
  const MatrixXd Y = measurements.information();
  EXPECT_TRUE(Y.topRows(4).isZero(0));
  EXPECT_LT((Y.bottomRightCorner(6, 6) - of_map).norm(), 1e-9 * of_map.norm());
}

// A waiting robot goes on measuring. Rows kept until the next motion would need a QR decomposition of 12000 x
// 12000
TEST(ObservabilityMonitor, MeasurementsWithoutMotionAreCondensed) {
  MonitorAndReference both(14, 4);
  for (int i = 0; i < 3; ++i) both.initialize(2, 0);
  int most = 0;
  for (int i = 0; i < 200; ++i) {
    both.measure_all(10);
    most = std::max(most, both.monitor.waiting_rows());
  }
  both.compare("waited");
  EXPECT_LE(most, 64 + max_measurement_rows);
}

// Ids are never reused: in a long run they are large, but few exist at a time
TEST(ObservabilityMonitor, StoresNothingOfDroppedBlocks) {
  ObservabilityMonitor monitor(vehicle, 2);
  for (const BlockId id : {5u, 4'000'000'000u, 7u}) {
    BlockAugmentation initialization{id, {{vehicle, MatrixXd::Identity(2, 2)}}, MatrixXd::Identity(2, 2)};
    monitor.augment(initialization);
  }
  monitor.drop(5);
  EXPECT_EQ(monitor.find(5), nullptr);
  EXPECT_EQ(monitor.find(4'000'000'000u)->first, 2);
  EXPECT_EQ(monitor.find(7)->first, 4);
  monitor.drop(7);
  EXPECT_EQ(monitor.blocks().size(), 2u);
  EXPECT_EQ(monitor.errors(), 4);
}

TEST(ObservabilityMonitor, GatheredInformationOutlastsTheBlock) {
  MonitorAndReference both(15, 4);
  for (int i = 0; i < 3; ++i) both.initialize(3, 0);
  both.measure_all(3);
  both.move(4, 1e3);
  both.measure_all(1);
  const VectorXd before = both.monitor.gathered();
  EXPECT_TRUE((before.array() >= both.monitor.information().diagonal().array() * (1 - 1e-12)).all());
  both.drop(2);
  const VectorXd after = both.monitor.gathered();
  ASSERT_EQ(after.size(), before.size() - 3);
  EXPECT_TRUE((after.segment(4, 3).array() >= before.segment(4, 3).array() * (1 - 1e-12)).all());
  EXPECT_GT(after[4], both.monitor.information()(4, 4));
}

// The copy of the vehicle's position has the stated exactness, all other errors their noise
TEST(ObservabilityMonitor, InitializationUsesTheStatedExactness) {
  BlockAugmentation initialization{1, {{vehicle, MatrixXd::Identity(3, 3)}}, MatrixXd::Zero(3, 3)};
  initialization.noise.diagonal() << 1e-8, 1e-8, 1e-8;
  initialization.noise(0, 2) = initialization.noise(2, 0) = 1e-9;  // not exact by itself
  ObservabilityMonitor monitor(vehicle, 3);
  monitor.set_exact_position(2, 0.05);
  monitor.augment(initialization);
  const VectorXd own = monitor.information().diagonal().tail(3);
  EXPECT_GT(own[0], 1e7);
  EXPECT_NEAR(own[1], 1 / (0.05 * 0.05), 1e-6);
  EXPECT_GT(own[2], 1e7);
}

// The filter's covariance is the inverse of this information plus the prior
TEST(ObservabilityMonitor, AgreesWithABeliefThatItFollows) {
  RandomStream random(5, "belief");
  Belief belief;
  const MatrixXd prior = 1e7 * MatrixXd::Identity(3, 3);
  const BlockId frame_motion = belief.add_vehicle(Chart::line(3), VectorXd::Zero(3), prior);
  belief.keep_trace(true);
  ObservabilityMonitor monitor(frame_motion, 3);
  std::vector<BlockId> landmarks;
  for (int step = 0; step < 12; ++step) {
    const MatrixXd G = 0.1 * random_matrix(random, 3, 2);
    const MatrixXd A = MatrixXd::Identity(3, 3) + 0.1 * random_matrix(random, 3, 3);
    belief.predict({frame_motion, VectorXd::Zero(3), A, G * G.transpose()});
    std::vector<LinearizedMeasurement> measurements;
    for (const BlockId id : landmarks) {
      LinearizedMeasurement& measurement = measurements.emplace_back();
      measurement.add(frame_motion, random_matrix(random, 2, 3));
      measurement.add(id, random_matrix(random, 2, 2));
      measurement.residual = VectorXd::Zero(2);
      measurement.R = 0.01 * MatrixXd::Identity(2, 2);
    }
    belief.update(measurements);
    if (step < 4) {
      const Belief::Parent parent{frame_motion, random_matrix(random, 2, 3)};
      landmarks.push_back(
          belief.augment(Chart::line(2), VectorXd::Zero(2), {&parent, 1}, 0.1 * MatrixXd::Identity(2, 2)));
    }
    if (step > 4) {  // one landmark keeps its errors
      std::vector<ErrorShear> shears;
      for (std::size_t i = 1; i < landmarks.size(); ++i)
        shears.push_back({landmarks[i], random_matrix(random, 2, 2)});
      belief.shear(frame_motion, 1, shears);
      belief.replace(frame_motion, Chart::line(3), VectorXd::Zero(3),
                     MatrixXd::Identity(3, 3) + 0.1 * random_matrix(random, 3, 3), MatrixXd::Zero(3, 3));
    }
    if (step == 8) belief.drop(landmarks[1]);
    if (step == 8) landmarks.erase(landmarks.begin() + 1);
    monitor.follow(belief.trace());
    belief.clear_trace();
  }
  const MatrixXd P = belief.dense_covariance();
  EXPECT_LT((monitor.information().inverse() - P).norm(), 1e-4 * P.norm());
}

// Moving information between vehicle and map adds none to what bounds the rounding error
TEST(ObservabilityMonitor, ShearDoesNotAddToWhatWasGathered) {
  MonitorAndReference both(16, 4);
  for (int i = 0; i < 3; ++i) both.initialize(3, 0);
  both.measure_all(3);
  const double before = both.monitor.gathered().tail(9).sum();
  for (int k = 0; k < 100; ++k) both.monitor.shear({vehicle, 1, {{1, 1e-6 * MatrixXd::Ones(3, 2)}}});
  EXPECT_LT(both.monitor.gathered().tail(9).sum(), 1.01 * before);
}

TEST(ObservabilityMonitor, ReportsWhatItDoesNotCover) {
  for (const auto& [how, why] :
       {std::pair{CovarianceEdit::frame_changed, ObservabilityMonitor::Uncovered::frame_changed},
        std::pair{CovarianceEdit::decorrelated, ObservabilityMonitor::Uncovered::decorrelated}}) {
    ObservabilityMonitor monitor(vehicle, 3);
    EXPECT_FALSE(monitor.uncovered());
    monitor.follow({how, BlockDrop{17}});
    EXPECT_EQ(monitor.uncovered(), why);
  }
  ObservabilityMonitor monitor(vehicle, 3);
  LinearizedMotion other;
  other.block = 5;
  monitor.follow({other});
  EXPECT_EQ(monitor.uncovered(), ObservabilityMonitor::Uncovered::other_block);
}

}  // namespace
}  // namespace incognita
